// The live page: pictures of a face that lives somewhere else, and what it says.
//
// In the query: background=transparent or a colour; mute; captions; status; microphone; bare (no buttons).
// Keys: f full screen, c captions, s status, m microphone. `window.mien.statistics()` tells how it goes.

import { Captions } from "./captions.js";
import { Recent } from "./clock.js";
import { decode, makeView } from "./frames.js";
import { Microphone } from "./microphone.js";
import { Pictures } from "./pictures.js";
import { hideWhenIdle, keepAwake, toggleFullscreen } from "./screen.js";
import { Connection } from "./socket.js";
import { Sound } from "./sound.js";
import { Notice, showMs, trouble, writeStatus } from "./status.js";

const REPORT_MS = 2000;
const WATCH_MS = 500;
const HIDDEN_MS = 1000;
const SPEECH_S = 10;
const CLEAR = [
  [0, 0, 0, 0],
  [0, 0, 0, 0],
];

const options = new URLSearchParams(location.search);
const background = options.get("background");
const transparent = background === "transparent";
const element = (id) => document.getElementById(id);
const nowS = () => performance.now() / 1000;

const pictures = new Pictures();
const offsets = new Recent(SPEECH_S);
const answers = new Recent(SPEECH_S);
const notice = new Notice(element("notice"));
const captions = new Captions(element("captions"), element("said"));

let view = null;
let setup = null;
/** @type {string | null} why there is no connection */
let why = "Connecting …";
/** @type {number | null} when the last picture came */
let cameS = null;
let askedS = 0;
let frameS = 0;

const sound = options.has("mute") ? null : new Sound((state) => (element("hear").hidden = state === "on"));

const connection = new Connection({
  subscription: () => ({ frames: true, events: true, sound: sound !== null }),
  onMessage: receive,
  onBinary: receiveBinary,
  onChange(reason) {
    why = reason;
    pictures.forget();
    if (reason !== null) {
      sound?.forget();
      captions.clear();
    }
    watch();
  },
});

const microphone = new Microphone(
  (rateHz, samples) => connection.sendVoice(rateHz, samples),
  (on, reason) => {
    press("microphone", on);
    if (reason) notice.pass(reason);
  },
);

/** @param {ArrayBuffer} buffer */
function receiveBinary(buffer) {
  const message = decode(buffer);
  // The page is behind the face where it has a background of its own.
  if (background !== null && message.background) message.background = CLEAR;
  if (message.type === "setup") begin(message);
  else if (message.type === "sound") sound?.keep(message.speech, message.rateHz, message.samples);
  else if (message.setup === setup?.setup) {
    pictures.add(message, slowS() > 0);
    if (document.hidden) pictures.look(nowS());
    cameS = nowS();
    if (!element("notice").hidden) watch();
  }
}

/** @param {import("./frames.js").Setup} message another face, or the same with other colours */
function begin(message) {
  view?.dispose();
  setup = message;
  pictures.forget();
  view = makeView(view?.canvas ?? element("face"), setup);
  element("stage").setAttribute("aria-label", `Face: ${setup.face}`);
  document.title = `${setup.face} · mien`;
}

/** @param {{kind: string, event?: string, id?: string}} message */
function receive(message) {
  if (message.id === "report") answers.add(nowS() - askedS, nowS());
  if (message.kind !== "event") return;
  if (message.event === "speech.started") {
    captions.start(message.text);
    sound?.start(message.speech, message.loop / setup.rate);
  } else if (message.event === "speech.word") {
    captions.word(message.word);
  } else if (message.event === "speech.ended") {
    captions.end(message.broken_off);
    sound?.end(message.speech, message.broken_off);
  } else if (message.event === "speech.failed") {
    notice.pass(message.message);
  }
}

function draw() {
  requestAnimationFrame(draw);
  const now = nowS();
  frameS = now;
  pictures.look(now);
  const { lagS } = pictures;
  if (lagS === null) return;
  const delayS = lagS + slowS();
  const heardS = sound?.heardS(now, delayS) ?? null;
  const wantedS = heardS ?? (slowS() > 0 ? now - delayS : null);
  // A picture that is ahead by less than can be seen need not wait for the next one.
  const picture = pictures.take(now, wantedS === null ? null : wantedS + 0.25 / setup.rate);
  if (picture) view.draw(picture);
  if (picture && heardS !== null) offsets.add(heardS - picture.timeS, now);
  acknowledge();
}

/** How much later than they could be pictures are drawn, for sound to keep up with them, seconds. */
function slowS() {
  return sound?.slowS ?? 0;
}

/** Tell that what has come is through; pictures that wait here for their sound hold up no others. */
function acknowledge() {
  const picture = pictures.tell();
  if (picture) connection.sendDrawn(picture.setup, picture.loop);
}

/** Browsers draw nothing that nobody sees: go on slowly, so that nothing lags when somebody looks again. */
function goOnUnseen() {
  if (nowS() - frameS > HIDDEN_MS / 1000) acknowledge();
}

/** Say what is wrong, and show numbers where they are wanted. */
function watch() {
  const text = trouble(why, cameS === null ? null : nowS() - cameS);
  document.body.classList.toggle("stale", cameS !== null && text !== "");
  // A film that this page is part of is no place for notices, once there is a face in it.
  notice.last(transparent && view ? "" : text);
  if (!element("status").hidden) writeStatus(element("status"), statusRows());
}

/** What embedders and tests read; times in seconds, null where nothing is known. */
function statistics() {
  pictures.draws.forget(nowS());
  return {
    connected: why === null,
    stale: document.body.classList.contains("stale"),
    face: setup?.face ?? null,
    loop: pictures.drawn?.loop ?? null,
    drawnFps: pictures.draws.perSecond,
    roundTripS: answers.percentile(0.5),
    sound: sound?.state ?? "off",
    speaking: sound?.saying?.number ?? null,
    sounding: Boolean(sound?.playing.length),
    soundLatencyS: sound?.latencyS ?? null,
    offsetP50S: offsets.percentile(0.5),
    offsetP95S: offsets.percentile(0.95, Math.abs),
  };
}

function statusRows() {
  const found = statistics();
  return [
    ["face", found.face ?? "–"],
    ["drawn", `${found.drawnFps.toFixed(1)} of ${setup?.rate ?? "–"} a second`],
    ["answer after", showMs(found.roundTripS)],
    ["sound", found.sound === "on" ? `on, ${showMs(found.soundLatencyS)} to the ear` : found.sound],
    ["sound before picture", `${showMs(found.offsetP50S)}, p95 ${showMs(found.offsetP95S)}`],
  ];
}

function report() {
  const { drawnFps, sound: state, offsetP50S, offsetP95S } = statistics();
  askedS = nowS();
  connection.send({
    kind: "report",
    id: "report",
    drawn_fps: drawnFps,
    sound: state,
    ...(offsetP95S !== null && { offset_p50_ms: 1000 * offsetP50S, offset_p95_ms: 1000 * offsetP95S }),
  });
}

/** @param {string} id of a button @param {boolean} pressed */
function press(id, pressed) {
  element(id).setAttribute("aria-pressed", String(pressed));
}

function toggleCaptions() {
  captions.show(!captions.shown);
  press("show-captions", captions.shown);
}

function toggleStatus() {
  element("status").hidden = !element("status").hidden;
  press("show-status", !element("status").hidden);
  watch();
}

const actions = {
  c: ["show-captions", toggleCaptions],
  s: ["show-status", toggleStatus],
  f: ["fullscreen", toggleFullscreen],
  m: ["microphone", () => microphone.toggle()],
};
for (const [id, act] of Object.values(actions)) element(id).addEventListener("click", act);
window.addEventListener("keydown", (event) => {
  if (!event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat) actions[event.key]?.[1]();
});
document.addEventListener("fullscreenchange", () => press("fullscreen", Boolean(document.fullscreenElement)));
for (const kind of ["pointerup", "keydown"]) window.addEventListener(kind, () => sound?.resume());

if (background !== null) document.documentElement.style.background = background;
element("controls").hidden = transparent || options.has("bare");
if (options.has("captions")) toggleCaptions();
if (options.has("status")) toggleStatus();
if (options.has("microphone")) void microphone.start();

new ResizeObserver(() => view?.resize()).observe(element("stage"));
window.mien = Object.freeze({ statistics });
keepAwake();
hideWhenIdle();
window.setInterval(watch, WATCH_MS);
window.setInterval(report, REPORT_MS);
window.setInterval(goOnUnseen, HIDDEN_MS);
draw();
