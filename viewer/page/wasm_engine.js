"use strict";

// culet's engine in WebAssembly: calls by JSON, pictures as arrays. Runs in a worker of the page,
// and in node for the tests.
class WasmEngine {
    /// `bytes`: the engine, compressed by gzip or not. Throws an Error with a message for people.
    static async from(bytes) {
        const packed = bytes[0] === 0x1f && bytes[1] === 0x8b;
        const code = packed ? await WasmEngine.unpacked(bytes) : bytes;
        const module = await WebAssembly.compile(code);
        const engine = new WasmEngine();
        const instance = await WebAssembly.instantiate(module, engine.imports(module));
        engine.exports = instance.exports;
        engine.exports._initialize();
        return engine;
    }

    static async unpacked(bytes) {
        const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
        return new Uint8Array(await new Response(stream).arrayBuffer());
    }

    static bytesOfBase64(text) {
        const binary = atob(text);
        const bytes = new Uint8Array(binary.length);
        for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
        return bytes;
    }

    constructor() {
        this.encoder = new TextEncoder();
        this.decoder = new TextDecoder();
        this.said = "";
    }

    /// What the C++ library needs from a system: time, and somewhere to write a last message. There
    /// are no files.
    imports(module) {
        const k_no_such_call = 52;
        const known = {
            clock_time_get: (clock, precision, place) => {
                const now = BigInt(Math.round(1e6 * performance.now()));
                this.view().setBigUint64(place, now, true);
                return 0;
            },
            environ_sizes_get: (count, size) => {
                this.view().setUint32(count, 0, true);
                this.view().setUint32(size, 0, true);
                return 0;
            },
            environ_get: () => 0,
            fd_write: (file, parts, count, written) => this.write(parts, count, written),
            proc_exit: code => {
                throw new Error(`the engine stopped (${code}) ${this.said}`);
            },
            emscripten_notify_memory_growth: () => {},
        };
        const imports = {};
        for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
            if (kind !== "function") throw new Error(`the engine asks for ${from}.${name}`);
            imports[from] ??= {};
            imports[from][name] = known[name] ?? (() => k_no_such_call);
        }
        return imports;
    }

    view() {
        return new DataView(this.exports.memory.buffer);
    }

    write(parts, count, written) {
        let size = 0;
        for (let i = 0; i < count; ++i) {
            const at = this.view().getUint32(parts + 8 * i, true);
            const length = this.view().getUint32(parts + 8 * i + 4, true);
            this.said = (this.said + this.text(at, length)).slice(-500);
            size += length;
        }
        this.view().setUint32(written, size, true);
        return 0;
    }

    text(at, size) {
        return this.decoder.decode(new Uint8Array(this.exports.memory.buffer, at, size));
    }

    put(bytes) {
        const place = this.exports.culet_take(bytes.length || 1);
        if (place === 0) throw new Error("this needs more memory than a page has");
        new Uint8Array(this.exports.memory.buffer, place, bytes.length).set(bytes);
        return place;
    }

    /// Returns the answer as an object. `attached`: a text or bytes. Throws an Error with one line
    /// for people.
    call(name, args = {}, attached = "") {
        const parts = [name, JSON.stringify(args), attached].map(
            part => typeof part === "string" ? this.encoder.encode(part) : part);
        const places = parts.map(part => this.put(part));
        let good = 0;
        try {
            good = this.exports.culet_call(places[0], parts[0].length, places[1], parts[1].length,
                                           places[2], parts[2].length);
        } finally {
            for (const place of places) this.exports.culet_give_back(place);
        }
        const answer = JSON.parse(this.text(this.exports.culet_answer(),
                                            this.exports.culet_answer_size()));
        if (!good) throw new Error(answer.error);
        return answer;
    }

    /// RGBA of the last "draw".
    pixels() {
        return new Uint8ClampedArray(this.exports.memory.buffer, this.exports.culet_pixels(),
                                     this.exports.culet_pixels_size()).slice();
    }

    /// RGBA of all textures of the last "gpu"; valid until the next call.
    texels() {
        return new Float32Array(this.exports.memory.buffer, this.exports.culet_texels(),
                                this.exports.culet_texels_size());
    }

    /// Linear RGB of the last "radiance".
    radiance() {
        return new Float32Array(this.exports.memory.buffer, this.exports.culet_radiance(),
                                this.exports.culet_radiance_size()).slice();
    }
}
