// The voice of who sits before the page, lent to the face.

const REASONS = {
  NotAllowedError: "The microphone is not allowed: allow it for this page in the browser.",
  NotFoundError: "There is no microphone.",
  NotReadableError: "The microphone is taken by another program.",
};

export class Microphone {
  /**
   * @param {(rateHz: number, samples: Int16Array) => void} onBlock hears 20 ms at a time
   * @param {(on: boolean, why: string | null) => void} onChange whether it is on, and why it is not
   */
  constructor(onBlock, onChange) {
    this.onBlock = onBlock;
    this.onChange = onChange;
    /** @type {AudioContext | null} */
    this.context = null;
    /** @type {MediaStream | null} */
    this.stream = null;
  }

  async toggle() {
    if (this.context) await this.stop();
    else await this.start();
  }

  async start() {
    if (!navigator.mediaDevices) {
      this.onChange(false, "Browsers lend the microphone only to pages of this computer (localhost) or over https.");
      return;
    }
    const context = new AudioContext();
    this.context = context;
    let stream;
    try {
      await context.audioWorklet.addModule("/page/microphone_worklet.js");
      stream = await navigator.mediaDevices.getUserMedia({ audio: { channelCount: 1, echoCancellation: true } });
    } catch (error) {
      await this.stop(REASONS[error.name] ?? `The microphone cannot be used (${error.message}).`);
      return;
    }
    if (this.context !== context) {
      // Somebody changed their mind while the browser asked.
      stream.getTracks().forEach((track) => track.stop());
      return;
    }
    this.stream = stream;
    const blocks = new AudioWorkletNode(context, "blocks", { numberOfOutputs: 0, channelCount: 1, channelCountMode: "explicit" });
    blocks.port.onmessage = ({ data }) => this.onBlock(context.sampleRate, data);
    context.createMediaStreamSource(stream).connect(blocks);
    stream.getAudioTracks()[0].onended = () => this.stop("The microphone is gone.");
    await context.resume();
    this.onChange(true, null);
  }

  /** @param {string | null} [why] in plain words, where nobody asked for it */
  async stop(why = null) {
    const { context, stream } = this;
    this.context = this.stream = null;
    stream?.getTracks().forEach((track) => track.stop());
    await context?.close();
    this.onChange(false, why);
  }
}
