"use strict";
// The engine's pixels on a canvas, for one stone or for two with a divider.

class PictureView {
  constructor(stage, canvas, still) {
    this.stage = stage;
    this.canvas = canvas;
    this.still = still;
    this.context = canvas.getContext("2d", {alpha: false, willReadFrequently: true});
    this.pictures = new Map();  // by side: "left" (or the only one), "right"
  }

  // The whole stage in screen pixels, limited to what an engine draws in reasonable time.
  size(scale = 1) {
    const box = this.stage.getBoundingClientRect();
    const ratio = (window.devicePixelRatio || 1) * scale;
    const most = 3.2e6, pixels = box.width * box.height * ratio * ratio;
    const factor = ratio * Math.min(1, Math.sqrt(most / Math.max(1, pixels)));
    return [
      Math.max(2, Math.round(box.width * factor)), Math.max(2, Math.round(box.height * factor))
    ];
  }

  // `drawn`: {width, height, pixels}.
  take(drawn, side = "left") {
    this.pictures.set(side, new ImageData(drawn.pixels, drawn.width, drawn.height));
  }
  forget() { this.pictures.clear(); }

  // `divider`: share of the width for the left stone, or null: one stone.
  show(side = "left", divider = null) {
    const picture = this.pictures.get(side) || this.pictures.get("left");
    if (!picture) return;
    if (this.canvas.width !== picture.width || this.canvas.height !== picture.height) {
      this.canvas.width = picture.width;
      this.canvas.height = picture.height;
    }
    this.context.putImageData(picture, 0, 0);
    const right = this.pictures.get("right");
    if (divider !== null && right && right.width === picture.width &&
      right.height === picture.height) {
      const from = Math.round(divider * right.width);
      this.context.putImageData(right, 0, 0, from, 0, right.width - from, right.height);
    }
    this.canvas.hidden = false;
    this.still.hidden = true;
  }

  png() {
    return new Promise(
      (resolve, reject) => this.canvas.toBlob(
        (blob) => blob ? resolve(blob) : reject(new Error("the browser made no PNG")),
        "image/png"));
  }
}
