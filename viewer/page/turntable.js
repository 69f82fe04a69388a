"use strict";
// A turn of the stone as a film: MP4 of exactly so many frames where the browser encodes films,
// else WebM, which a browser records in real time.

const k_film_rate = 25;   // per second
const k_film_most = 720;  // pixels per side
const k_film_bits = 8e6;  // per second
const k_film_slice_ms = 40;
// H.264 of the baseline, whose frames come in order, and VP9; both of level 3.1.
const k_film_codecs = ["avc1.42E01F", "vp09.00.31.08"];

class FilmEncoder {
  // Nothing if this browser encodes no film of that size.
  static async of(width, height) {
    if (typeof VideoEncoder !== "function") return null;
    for (const codec of k_film_codecs) {
      const config = {codec, width, height, bitrate: k_film_bits, framerate: k_film_rate};
      if (codec.startsWith("avc1")) config.avc = {format: "avc"};
      const {supported} = await VideoEncoder.isConfigSupported(config).catch(() => ({}));
      if (supported) return new FilmEncoder(config);
    }
    return null;
  }
  constructor(config) {
    this.config = config;
    this.samples = [];
    this.encoder = new VideoEncoder({
      output: (chunk, {decoderConfig} = {}) => {
        const bytes = new Uint8Array(chunk.byteLength);
        chunk.copyTo(bytes);
        this.samples.push({bytes, key: chunk.type === "key"});
        this.decoder = decoderConfig || this.decoder;
      },
      error: (error) => {
        this.failure = error;
      },
    });
    this.encoder.configure(config);
  }
  add({data, width, height}, index) {
    if (this.failure) throw this.failure;
    const frame = new VideoFrame(data, {
      format: "RGBX",
      codedWidth: width,
      codedHeight: height,
      timestamp: Math.round(1e6 * index / k_film_rate),
    });
    this.encoder.encode(frame, {keyFrame: index % k_film_rate === 0});
    frame.close();
  }
  async finish(count) {
    await this.encoder.flush();
    this.encoder.close();
    if (this.failure || this.samples.length !== count)
      throw this.failure || new Error("the browser\u2019s encoder lost frames of the film");
    const {width, height, codec} = this.config;
    return mp4_file({...this.decoder, codec}, width, height, k_film_rate, this.samples);
  }
  stop() {
    if (this.encoder.state !== "closed") this.encoder.close();
  }
}

// Keeps the frames, and plays them to the recorder in the end.
class FilmRecorder {
  static type() {
    if (typeof MediaRecorder !== "function" || !HTMLCanvasElement.prototype.captureStream)
      return "";
    // VP8 first: a recorder that does not keep up drops frames.
    return ["video/webm;codecs=vp8", "video/webm"].find(
      (type) => MediaRecorder.isTypeSupported(type));
  }
  constructor() { this.frames = []; }
  add(frame) { this.frames.push(frame); }
  stop() {}

  async finish() {
    const frames = this.frames, {width, height} = frames[0];
    const canvas = element("canvas", {width, height});
    const context = canvas.getContext("2d", {alpha: false});
    const stream = canvas.captureStream(0), chunks = [];
    const recorder =
      new MediaRecorder(stream, {mimeType: FilmRecorder.type(), videoBitsPerSecond: k_film_bits});
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
      await pause(Math.max(0, begin + 1000 * (i + 1) / k_film_rate - performance.now()));
    }
    recorder.stop();
    await ended;
    track.stop();
    return new Blob(chunks, {type: "video/webm"});
  }
}

class Turntable {
  constructor(page) {
    this.page = page;
    this.recording = false;
  }
  stop() { this.recording = false; }

  // The film as a blob, or nothing if it was stopped. `progress(share)` after each frame.
  async film(seconds, progress) {
    const page = this.page, count = Math.round(seconds * k_film_rate);
    this.recording = true;
    await page.loop.idle();
    page.loop.paused = true;
    const [w, h] = page.picture.size();
    const factor = Math.min(1, k_film_most / Math.max(w, h));
    const width = 2 * Math.round(w * factor / 2), height = 2 * Math.round(h * factor / 2);
    const film =
      await FilmEncoder.of(width, height) || (FilmRecorder.type() ? new FilmRecorder() : null);
    if (!film) throw new Error("This browser makes no films; culet render --frames makes one.");
    try {
      const view = page.view(), stone = page.shown_index(), exposure = page.exposure_factor();
      for (let i = 0; i < count && this.recording; ++i) {
        const turn =
          Turn.after(view.turn, Turn.about(page.shown_stone().up, 2 * Math.PI * i / count));
        const drawn = await page.loop.ask(stone, page.loop.settings(stone), "draw", {
          ...page.drawing(stone, width, height, {...view, turn}),
          engine: page.drawn_by_rays ? "preview" : "beams",
          exposure,
          tonemap: page.tonemap(),
        });
        if (!drawn) throw new Error("the film was not finished: another stone was opened");
        film.add(new ImageData(drawn.pixels, width, height), i);
        progress((i + 1) / count);
      }
      return this.recording ? await film.finish(count) : null;
    } finally {
      film.stop();
      this.recording = false;
    }
  }
}
