"use strict";
// culet's GPU kernel in WebGL2: compiles its sources, holds its textures and sums, draws samples.
// render/gpu/gpu_program.h documents what the sources need.

class GpuProgramError extends Error {}

class GpuProgram {
  // `gl`: a WebGL2 context with EXT_color_buffer_float. `program`: {vertex, kernel, display,
  // uniforms, passes, textures}.
  constructor(gl, program) {
    this.gl = gl;
    this.kernel = this.linked(program.vertex, program.kernel);
    this.display = this.linked(program.vertex, program.display);
    this.places = new Map();
    this.textures = [];
    this.sums = [];
    this.size = [0, 0];
    this.vertices = gl.createVertexArray();
    this.fill(program);
  }

  fill(program) {
    const gl = this.gl;
    this.passes = program.passes;
    gl.useProgram(this.kernel);
    this.set(program.uniforms);
    if (!program.textures) return;  // they are unchanged
    for (const texture of this.textures) gl.deleteTexture(texture.made);
    this.textures = program.textures.map((texture) => {
      const made =
        this.float_texture(texture.width, texture.height, new Float32Array(texture.values));
      gl.uniform1i(this.place(texture.name), texture.unit);
      return {unit: texture.unit, made};
    });
  }

  linked(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(
        shader, source.startsWith("#version") ? source : "#version 300 es\n" + source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      gl.deleteShader(shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new GpuProgramError("this GPU does not take the kernel: " +
        (gl.getProgramInfoLog(program) || "no reason given").split("\n")[0]);
    }
    return program;
  }

  place(name) {
    if (!this.places.has(name))
      this.places.set(name, this.gl.getUniformLocation(this.kernel, name));
    return this.places.get(name);
  }
  set(uniforms) {
    const gl = this.gl;
    for (const {name, components, whole, values} of uniforms) {
      const place = this.place(name);
      if (place === null) continue;
      if (components === 9)
        gl.uniformMatrix3fv(place, false, values);
      else if (whole)
        gl[`uniform${components}iv`](place, new Int32Array(values));
      else
        gl[`uniform${components}fv`](place, new Float32Array(values));
    }
  }

  float_texture(width, height, values) {
    const gl = this.gl, texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, values);
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.NEAREST],
           [gl.TEXTURE_MAG_FILTER, gl.NEAREST], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
           [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, key, value);
    return texture;
  }

  begin(width, height) {
    const gl = this.gl;
    this.keep = 0;
    if (this.size[0] === width && this.size[1] === height) return;
    for (const {texture, frame} of this.sums) {
      gl.deleteTexture(texture);
      gl.deleteFramebuffer(frame);
    }
    this.sums = [0, 1].map(() => {
      const texture = this.float_texture(width, height, null), frame = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      return {texture, frame};
    });
    this.size = [width, height];
  }

  // Adds one sample per pixel; `uniforms` belong to this sample's view.
  add(uniforms) {
    const gl = this.gl;
    gl.useProgram(this.kernel);
    gl.bindVertexArray(this.vertices);
    this.set(uniforms);
    for (const {unit, made} of this.textures) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, made);
    }
    gl.viewport(0, 0, ...this.size);
    for (const pass of this.passes) {
      this.set(pass.uniforms);
      const [from, to] = this.sums;
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, from.texture);
      gl.uniform1i(this.place("u_sum"), 0);
      gl.uniform1f(this.place("u_keep"), this.keep);
      gl.bindFramebuffer(gl.FRAMEBUFFER, to.frame);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      this.sums = [to, from];
      this.keep = 1;
    }
  }

  // `exposure` is already divided by the number of samples; `tone_map` is a number
  // (render/image/film_look.h).
  show(exposure, tone_map) {
    const gl = this.gl;
    gl.useProgram(this.display);
    gl.bindVertexArray(this.vertices);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.sums[0].texture);
    gl.uniform1i(gl.getUniformLocation(this.display, "u_sum"), 0);
    gl.uniform1f(gl.getUniformLocation(this.display, "u_exposure"), exposure);
    gl.uniform1i(gl.getUniformLocation(this.display, "u_tone_map"), tone_map);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, ...this.size);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
