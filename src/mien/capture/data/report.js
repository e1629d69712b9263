"use strict";

// Tables: a click on a head sorts by it, a second one the other way round.
for (const table of document.querySelectorAll("table.sortable")) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    head.querySelector("button").addEventListener("click", () => {
      const sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
      const body = table.tBodies[0];
      const key = (row) => row.cells[column].dataset.key ?? row.cells[column].textContent;
      const compare = (a, b) => {
        const difference = Number(a) - Number(b);
        return Number.isNaN(difference) ? a.localeCompare(b, undefined, { numeric: true }) : difference;
      };
      body.append(...[...body.rows].sort((a, b) => sign * compare(key(a), key(b))));
    });
  });
}

// Photographs: names on and off, large and small.
const names = document.getElementById("names");
const showNames = () => document.body.classList.toggle("nameless", !names.checked);
names.addEventListener("change", showNames);
showNames();
for (const picture of document.querySelectorAll(".photograph > svg")) {
  picture.addEventListener("click", () => picture.parentElement.classList.toggle("large"));
}

// Points in space, to be turned by hand.
class Orbit {
  constructor(figure) {
    this.canvas = figure.querySelector("canvas");
    this.told = figure.querySelector("figcaption span");
    this.scene = JSON.parse(figure.querySelector("script").textContent);
    this.turn = 0.4;
    this.tilt = 0.15;
    this.near = 1;
    const reach = Math.max(...this.scene.points.map((point) => Math.hypot(...point.at)), 1e-9);
    this.scale = (0.46 * this.canvas.height) / reach;
    this.followPointer();
    this.canvas.addEventListener("keydown", (event) => this.press(event));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    figure.hidden = false;
    this.draw();
  }

  followPointer() {
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) {
        this.turn -= event.movementX * 0.008;
        this.tilt = Math.min(1.5, Math.max(-1.5, this.tilt + event.movementY * 0.008));
        this.draw();
      } else {
        this.tell(event);
      }
    });
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.approach(Math.exp(-event.deltaY * 0.0012));
      },
      { passive: false },
    );
  }

  press(event) {
    const steps = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    if (event.key in steps) {
      this.turn += steps[event.key][0];
      this.tilt = Math.min(1.5, Math.max(-1.5, this.tilt + steps[event.key][1]));
      this.draw();
    } else if (event.key === "+" || event.key === "-") {
      this.approach(event.key === "+" ? 1.15 : 1 / 1.15);
    } else {
      return;
    }
    event.preventDefault();
  }

  approach(factor) {
    this.near = Math.min(30, Math.max(0.3, this.near * factor));
    this.draw();
  }

  // Rows: right, down and towards the viewer.
  axes() {
    const [c, s, ct, st] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt), Math.sin(this.tilt)];
    return [
      [c, 0, -s],
      [st * s, -ct, st * c],
      [ct * s, st, ct * c],
    ];
  }

  draw() {
    const { canvas, scene } = this;
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(`--${name}`).trim() || style.getPropertyValue("--measured");
    const context = canvas.getContext("2d");
    const axes = this.axes();
    const scale = this.scale * this.near;
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const place = ({ at }) => [
      canvas.width / 2 + scale * dot(axes[0], at),
      canvas.height / 2 + scale * dot(axes[1], at),
      dot(axes[2], at),
    ];
    this.shown = scene.points.map((point) => ({ point, at: place(point) }));
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.strokeStyle = color("faint");
    context.globalAlpha = 0.4;
    context.beginPath();
    for (const [a, b] of scene.edges) {
      context.moveTo(this.shown[a].at[0], this.shown[a].at[1]);
      context.lineTo(this.shown[b].at[0], this.shown[b].at[1]);
    }
    context.stroke();
    context.fillStyle = color("reference");
    for (const point of scene.references) {
      const [u, v] = place(point);
      context.fillRect(u - 3, v - 3, 6, 6);
    }
    for (const { point, at } of [...this.shown].sort((a, b) => a.at[2] - b.at[2])) {
      const [xx, xy, xz, yy, yz, zz] = point.spread;
      const times = (m) => [
        xx * m[0] + xy * m[1] + xz * m[2],
        xy * m[0] + yy * m[1] + yz * m[2],
        xz * m[0] + yz * m[1] + zz * m[2],
      ];
      const [p, q, r] = [dot(axes[0], times(axes[0])), dot(axes[0], times(axes[1])), dot(axes[1], times(axes[1]))];
      const middle = (p + r) / 2;
      const half = Math.hypot((p - r) / 2, q);
      const size = scene.reach * scene.times * scale;
      context.fillStyle = context.strokeStyle = color(point.kind);
      context.beginPath();
      context.ellipse(
        at[0],
        at[1],
        size * Math.sqrt(middle + half),
        size * Math.sqrt(Math.max(middle - half, 0)),
        Math.atan2(2 * q, p - r) / 2,
        0,
        2 * Math.PI,
      );
      context.globalAlpha = 0.22;
      context.fill();
      context.globalAlpha = 0.9;
      context.stroke();
      context.fillRect(at[0] - 1.5, at[1] - 1.5, 3, 3);
    }
    context.globalAlpha = 1;
  }

  // The name and place of the point under the pointer.
  tell(event) {
    const box = this.canvas.getBoundingClientRect();
    const u = ((event.clientX - box.left) * this.canvas.width) / box.width;
    const v = ((event.clientY - box.top) * this.canvas.height) / box.height;
    const far = ({ at }) => Math.hypot(at[0] - u, at[1] - v);
    const nearest = this.shown.reduce((best, each) => (far(each) < far(best) ? each : best));
    if (far(nearest) > 15) {
      this.told.textContent = "";
      return;
    }
    const { name, kind, spread } = nearest.point;
    const sigma = Math.sqrt((spread[0] + spread[3] + spread[5]) / 3);
    this.told.textContent = `${name} (${kind}), σ ${sigma.toFixed(this.scene.decimals)} ${this.scene.unit}`;
  }
}

for (const figure of document.querySelectorAll(".orbit")) new Orbit(figure);
