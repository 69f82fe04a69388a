"use strict";
// A turn of the stone as a WebM film. Frames are drawn first, then played to the recorder, which
// records in real time.

const k_film_frames = 100;
const k_film_rate = 25;   // per second
const k_film_most = 720;  // pixels per side
const k_film_slice_ms = 40;

class Turntable {
  constructor(page) {
    this.page = page;
    this.recording = false;
  }
  static refusal() {
    if (typeof MediaRecorder !== "function" || !HTMLCanvasElement.prototype.captureStream) {
      return "This browser records no films; culet render --frames makes one.";
    }
    return Turntable.type() ? ""
                            : "This browser records no WebM; culet render --frames makes a film.";
  }
  static type() {
    // VP8 first: a recorder that does not keep up drops frames.
    return ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"].find(
      (type) => MediaRecorder.isTypeSupported(type));
  }
  stop() { this.recording = false; }

  // The film as a blob, or nothing if it was stopped.
  async film(progress) {
    const page = this.page;
    this.recording = true;
    await page.loop.idle();
    page.loop.paused = true;
    const [w, h] = page.picture.size();
    const factor = Math.min(1, k_film_most / Math.max(w, h));
    const width = 2 * Math.round(w * factor / 2), height = 2 * Math.round(h * factor / 2);
    const frames = await this.frames(width, height, progress);
    const film = this.recording ? await this.play(frames, width, height, progress) : null;
    this.recording = false;
    return film;
  }

  async frames(width, height, progress) {
    const page = this.page, frames = [], view = page.view(), stone = page.shown_index();
    const exposure = page.exposure_factor();
    for (let i = 0; i < k_film_frames && this.recording; ++i) {
      const turn =
        Turn.after(view.turn, Turn.about(page.shown_stone().up, 2 * Math.PI * i / k_film_frames));
      const drawn = await page.loop.ask(stone, page.loop.settings(stone), "draw", {
        ...page.drawing(stone, width, height, {...view, turn}),
        engine: page.drawn_by_rays ? "preview" : "beams",
        exposure,
        tonemap: page.tonemap(),
      });
      if (!drawn) throw new Error("the film was not finished: another stone was opened");
      frames.push(new ImageData(drawn.pixels, width, height));
      progress(0.7 * (i + 1) / k_film_frames);
    }
    return frames;
  }

  async play(frames, width, height, progress) {
    const canvas = element("canvas", {width, height});
    const context = canvas.getContext("2d", {alpha: false});
    const stream = canvas.captureStream(0), chunks = [];
    const recorder =
      new MediaRecorder(stream, {mimeType: Turntable.type(), videoBitsPerSecond: 8e6});
    recorder.ondataavailable = (event) => chunks.push(event.data);
    const ended = new Promise((resolve, reject) => {
      recorder.onstop = resolve;
      recorder.onerror = () => reject(new Error("the browser stopped recording"));
    });
    // The recorder starts slowly; what is played before its first bytes is lost.
    const [track] = stream.getVideoTracks();
    const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const show = (frame) => {
      context.putImageData(frame, 0, 0);
      track.requestFrame();
    };
    recorder.start(k_film_slice_ms);
    while (!chunks.some((chunk) => chunk.size > 0) && recorder.state === "recording") {
      show(frames[0]);
      await pause(k_film_slice_ms);
    }
    const begin = performance.now();
    for (const [i, frame] of frames.entries()) {
      show(frame);
      progress(0.7 + 0.3 * (i + 1) / frames.length);
      await pause(Math.max(0, begin + 1000 * (i + 1) / k_film_rate - performance.now()));
    }
    recorder.stop();
    await ended;
    track.stop();
    return new Blob(chunks, {type: "video/webm"});
  }
}
