"use strict";

// A page's worker: takes {id, call, ...arguments} one by one and answers {id, ok: true, ...result}
// or {id, ok: false, error: "one line"} (docs/viewer.md). The first call is "start" with `engine`,
// the engine's file as bytes, or as text in base64.
class EngineWorker {
    constructor(post) {
        this.post = post;
        this.engine = null;
        this.waiting = [];
        this.busy = false;
        // Runs after the messages that have already been sent, so that the newest picture is known.
        this.later = new MessageChannel();
        this.later.port1.onmessage = () => this.next();
    }

    take(message) {
        this.waiting.push(message);
        if (!this.busy) {
            this.busy = true;
            this.later.port2.postMessage(null);
        }
    }

    async next() {
        const message = this.waiting.shift();
        await this.answer(message);
        if (this.waiting.length > 0) {
            this.later.port2.postMessage(null);
        } else {
            this.busy = false;
        }
    }

    async answer(message) {
        const { id, call, ...args } = message;
        try {
            if (call === "draw" && this.waiting.some(other => other.call === "draw"))
                throw new Error("overtaken");
            const { result, transfer } = await this.result(call, args);
            this.post({ id, ok: true, ...result }, transfer);
        } catch (problem) {
            const lost = problem.lost || problem instanceof WebAssembly.RuntimeError || problem instanceof RangeError;
            if (lost) this.engine = null;
            const words = lost ? `the engine stopped: ${problem.message}` : problem.message;
            this.post({ id, ok: false, error: words, died: lost }, []);
        }
    }

    async result(call, args) {
        if (call === "start") {
            // The studio gives its own.
            if (this.engine !== null) return { result: {}, transfer: [] };
            const bytes = typeof args.engine === "string" ? WasmEngine.bytesOfBase64(args.engine)
                                                          : new Uint8Array(args.engine);
            this.engine = await WasmEngine.from(bytes);
            return { result: {}, transfer: [] };
        }
        if (this.engine === null) throw new Error("the engine has not been started");
        if (call === "open") {
            const { document, ...rest } = args;
            const text = typeof document === "string" ? document : JSON.stringify(document);
            return { result: await this.engine.call(call, rest, text), transfer: [] };
        }
        if (call === "panorama" || call === "stone") {
            const { bytes, ...rest } = args;
            return { result: await this.engine.call(call, rest, new Uint8Array(bytes)), transfer: [] };
        }
        const result = await this.engine.call(call, args);
        if (call === "draw") {
            result.pixels = this.engine.pixels();
            return { result, transfer: [result.pixels.buffer] };
        }
        if (call === "gpu") {
            const textures = result.textures ?? [], all = this.engine.texels();
            for (const texture of textures)
                texture.values = all.slice(texture.first, texture.first + 4 * texture.width * texture.height);
            return { result, transfer: textures.map(texture => texture.values.buffer) };
        }
        if (call === "radiance") {
            result.radiance = this.engine.radiance();
            return { result, transfer: [result.radiance.buffer] };
        }
        return { result, transfer: [] };
    }
}

if (typeof WorkerGlobalScope !== "undefined" && self instanceof WorkerGlobalScope) {
    const worker = new EngineWorker((answer, transfer) => self.postMessage(answer, transfer));
    self.onmessage = event => worker.take(event.data);
}
