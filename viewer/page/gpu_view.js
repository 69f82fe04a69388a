"use strict";
// The picture by the GPU, if it can draw the scene and is faster than the engine: one sample per
// pixel while the stone moves, then more and more.

const k_gpu_samples = 64;
const k_gpu_ms = 8000;  // after this a slow GPU keeps the samples it has
// For display.frag.glsl, as in render/image/film_look.h.
const k_gpu_tone_maps = {
  none: 0,
  reinhard: 1,
  filmic: 2,
  gamma2: 3
};

class GpuView {
  constructor(page, canvas) {
    this.page = page;
    this.canvas = canvas;
    this.shown = false;
    this.drew = false;
    this.scene_refusal = "";  // of the current scene
    this.own_refusal = "";    // of this machine
    this.lost = false;
    this.program = null;
    this.program_key = "";
    this.sample_ms = null;  // of one sample per pixel, for a million pixels
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();  // otherwise it is never restored
      this.lost = true;
      this.hide();
      page.loop.changed();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.gl.getExtension("EXT_color_buffer_float");  // a restored context has lost it
      this.program = null;
      this.program_key = "";
      page.loop.changed();
    });
  }

  // Created on first use: most pages never need it.
  context() {
    if (this.gl || this.own_refusal) return this.gl;
    const gl = this.canvas.getContext("webgl2", {
      alpha: false,
      antialias: false,
      preserveDrawingBuffer: true,
      powerPreference: "high-performance"
    });
    if (!gl)
      this.own_refusal = "this browser has no WebGL2";
    else if (!gl.getExtension("EXT_color_buffer_float"))
      this.own_refusal = "it cannot sum in floating point";
    else
      this.gl = gl;
    if (this.gl) {
      const about = gl.getExtension("WEBGL_debug_renderer_info");
      const name = about ? gl.getParameter(about.UNMASKED_RENDERER_WEBGL) : "";
      // A GPU that is emulated on the processor competes with the engine for it, and loses.
      this.software = /swiftshader|llvmpipe|software|basic render/i.test(name);
    }
    return this.gl;
  }

  // Why it cannot draw; empty: it can.
  refusal() { return this.own_refusal || this.scene_refusal; }
  took_settings(answer) {
    this.scene_refusal = answer.gpu_refused ?? "this page\u2019s engine has no kernel for it";
    this.program_key = "";
  }

  wanted() {
    const values = this.page.state.values, how = values.drawn_by;
    if (how === "beams" || values.compare !== "one" || this.lost) return false;
    if (this.scene_refusal || !this.context()) return false;
    if (how === "gpu") return true;
    if (this.software) return false;
    // While its speed is unknown, the GPU is tried once.
    const {preview} = this.page.loop.milliseconds;
    return this.sample_ms === null || preview === undefined || this.sample_ms < preview;
  }

  hide() {
    this.shown = false;
    this.canvas.hidden = true;
  }

  async draw(settings, width, height, quick, exposure) {
    this.drew = false;
    const page = this.page, version = page.loop.version;
    try {
      await this.samples(settings, width, height, quick, exposure, version);
    } catch (error) {
      if (error instanceof EngineError) throw error;
      if (this.gl.isContextLost()) return;
      this.own_refusal = error.message;
      this.hide();
    }
  }

  async samples(settings, width, height, quick, exposure, version) {
    const page = this.page, gl = this.context(), count = quick ? 1 : k_gpu_samples;
    const stone = page.shown_index();
    const answer = await page.loop.ask(stone, settings, "gpu", {
      ...page.drawing(stone, width, height),
      samples: count,
      known: this.program_key,
    });
    if (!answer) return;
    if (answer.key !== this.program_key || !this.program) {
      this.program = new GpuProgram(gl, answer);
      this.program_key = answer.key;
    } else {
      this.program.fill(answer);
    }
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const tone_map = k_gpu_tone_maps[page.tonemap()] || 0;
    this.program.begin(width, height);
    const started = performance.now();
    for (let sample = 0; sample < Math.min(count, answer.samples.length); ++sample) {
      const begin = performance.now();
      this.program.add(answer.samples[sample]);
      this.program.show(exposure / (sample + 1), tone_map);
      // Waits until the sample is drawn, to measure its time.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      if (gl.isContextLost()) return;
      const spent = performance.now() - begin;
      if (quick) page.loop.adapt(spent, spent);
      // The first may include the kernel's compilation.
      const late = performance.now() - started > k_gpu_ms;
      if (sample > 0 || count === 1 || late) page.loop.milliseconds.gpu = this.sample_ms = spent;
      this.shown = this.drew = true;
      this.canvas.hidden = false;
      page.picture.still.hidden = true;
      await new Promise(requestAnimationFrame);
      if (page.loop.version !== version || late) return;
    }
  }

  png() {
    return new Promise(
      (resolve, reject) => this.canvas.toBlob(
        (blob) => blob ? resolve(blob) : reject(new Error("the browser made no PNG")),
        "image/png"));
  }
}
