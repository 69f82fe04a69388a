"use strict";
// The engine in its worker: calls and their answers. There is one worker at a time; `start`
// replaces a dead one.

class EngineError extends Error {}

class EngineClient {
  // `ondeath(line)` is called when the worker ends unexpectedly.
  constructor(ondeath) {
    this.ondeath = ondeath;
    this.waiting = new Map();
    this.next_id = 1;
    this.worker = null;
    this.turns = Promise.resolve();
  }

  // Why this page can have no engine; empty: it can.
  static refusal() {
    if (typeof WebAssembly !== "object")
      return "This browser has no WebAssembly, so the stone cannot be turned here: the picture is what culet drew.";
    if (!EngineClient.text_of("culet-engine")) {
      return "The stone does not turn here, because culet had no engine to put into this page. Run " +
        "\u201csh viewer/engine.sh\u201d in culet\u2019s source folder, then make the page again.";
    }
    if (typeof DecompressionStream !== "function")
      return "This browser is too old to unpack culet\u2019s engine: the picture is what culet drew.";
    return "";
  }
  static text_of(id) {
    const block = document.getElementById(id);
    return block ? block.textContent.trim() : "";
  }

  // In the studio the page around this one offers the program as the engine, which is faster.
  static offered() {
    if (parent === window) return Promise.resolve(null);
    const k_offer_ms = 300;
    const {port1, port2} = new MessageChannel();
    return new Promise((resolve) => {
      port1.onmessage = () => resolve(port1);
      setTimeout(() => resolve(null), k_offer_ms);
      parent.postMessage({culet: "engine"}, "*", [port2]);
    });
  }

  async start() {
    this.stop("started again");
    const port = await EngineClient.offered();
    if (port) {
      this.worker = {
        postMessage: (message, transfer) => port.postMessage(message, transfer),
        terminate: () => port.close(),
      };
      port.onmessage = (event) => this.answered(event.data);
      return this.call("start");
    }
    const address = URL.createObjectURL(
      new Blob([EngineClient.text_of("culet-worker")], {type: "text/javascript"}));
    const worker = this.worker = new Worker(address);
    worker.onmessage = (event) => this.answered(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      if (this.worker === worker) this.died(event.message || "the engine stopped");
    };
    // The base64 text is not needed again.
    return this.call("start", {engine: EngineClient.text_of("culet-engine")})
      .finally(() => URL.revokeObjectURL(address));
  }

  stop(why) {
    if (this.worker) this.worker.terminate();
    this.worker = null;
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const {reject} of waiting) reject(new EngineError(why));
  }
  died(line) {
    this.stop(line);
    this.ondeath(line);
  }

  call(call, args = {}, transfer = []) {
    if (!this.worker) return Promise.reject(new EngineError("the engine is not running"));
    const id = this.next_id++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      this.worker.postMessage({id, call, ...args}, transfer);
    });
  }
  // Runs several calls without calls of others between them. Must not be nested.
  in_turn(work) {
    const mine = this.turns.then(work);
    this.turns = mine.catch(() => {});
    return mine;
  }
  answered(answer) {
    const waiting = this.waiting.get(answer.id);
    if (!waiting) {
      if (answer.died) this.died(answer.error || "the engine stopped");
      return;
    }
    this.waiting.delete(answer.id);
    if (answer.ok)
      waiting.resolve(answer);
    else
      waiting.reject(new EngineError(answer.error || "the engine gave no reason"));
    if (answer.died) this.died(answer.error);
  }
}
