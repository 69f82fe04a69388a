// The program as the engine of the stone that turns: the stone's page, in its frame, asks by a port of messages; its calls
// are those of a page that has the engine inside (viewer/page/worker.js).
"use strict";
class ProgramEngine {
  async call(name, args = {}, attached = "") {
    const head = JSON.stringify({call: name, arguments: args}) + "\n";
    const answer = await fetch(`/api/engine?window=${window_id}`, {method: "POST", body: new Blob([head, attached])});
    if (!answer.ok) {
      const {trouble, died} = await answer.json();
      throw Object.assign(new Error(trouble), {lost: died});
    }
    const bytes = await answer.arrayBuffer(), line = new Uint8Array(bytes).indexOf(10);
    this.bytes = bytes.slice(line + 1);
    return JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 0, line)));
  }
  pixels() { return new Uint8ClampedArray(this.bytes); }
  radiance() { return new Float32Array(this.bytes); }
  texels() { return new Float32Array(this.bytes); }
}

/** Answers the page in `frame`, which asks for an engine when it starts. */
function serve_engine(frame) {
  addEventListener("message", (event) => {
    const port = event.ports[0];
    if (event.source !== frame.contentWindow || !port || !event.data || event.data.culet !== "engine") return;
    const worker = new EngineWorker((answer, transfer) => port.postMessage(answer, transfer));
    worker.engine = new ProgramEngine();
    port.onmessage = (message) => worker.take(message.data);
    port.postMessage("ready");
  });
}
