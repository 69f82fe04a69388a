"use strict";

// The pages' engine, in WebAssembly, against the program's own: the same calls, the same pictures.
// Expectation: the program's engine, whose bytes viewer_engine_test.cpp holds against `culet render`.
// Vectors of other widths add up in another order and exponentials differ in their last digits, so
// that a byte may round the other way: 99.9 % of pixels are asked to be within 1 of 255.
// usage: node wasm_engine_test.js viewer_engine_answers viewer-engine.wasm.gz

const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

const page = path.join(__dirname, "../../viewer/page");
vm.runInThisContext(fs.readFileSync(path.join(page, "wasm_engine.js"), "utf8") +
                    "\nglobalThis.WasmEngine = WasmEngine;");

let failures = 0;
function expect(truth, what) {
    if (truth) return;
    ++failures;
    console.error(`FAILED: ${what}`);
}

function difference(one, other) {
    let apart = 0, worst = 0;
    for (let p = 0; p < one.length; p += 4) {
        let most = 0;
        for (let c = 0; c < 4; ++c) most = Math.max(most, Math.abs(one[p + c] - other[p + c]));
        if (most > 1) ++apart;
        worst = Math.max(worst, most);
    }
    return { share: apart / (one.length / 4), worst };
}

async function main() {
    const [answers, file] = process.argv.slice(2);
    const cases = JSON.parse(execFileSync(answers, { maxBuffer: 1 << 30 }).toString());
    const begin = performance.now();
    const engine = await WasmEngine.from(new Uint8Array(fs.readFileSync(file)));
    console.log(`started in ${(performance.now() - begin).toFixed(0)} ms, ` +
                `${(fs.statSync(file).size / 1e6).toFixed(2)} MB`);
    expect(cases.length >= 12, "the program answers at least 12 cases");
    for (const one of cases) {
        engine.call("open", { item: 0 }, JSON.stringify(one.document));
        engine.call("set", one.set);
        const answer = engine.call("draw", one.draw);
        const { share, worst } = difference(engine.pixels(), Buffer.from(one.pixels, "base64"));
        console.log(`${one.what}: ${answer.milliseconds.toFixed(1)} ms (program ` +
                    `${one.answer.milliseconds.toFixed(1)} ms), ${(100 * share).toFixed(3)} % of ` +
                    `pixels over 1, worst ${worst}, beams ${answer.beams} and ${one.answer.beams}`);
        expect(share <= 0.001, `${one.what}: pixels are those of the program`);
        expect(JSON.stringify(answer.wavelengths) === JSON.stringify(one.answer.wavelengths),
               `${one.what}: wavelengths are those of the program`);
    }
    // What is refused is said in one line, and the engine goes on.
    const refusal = (call, args, attached) => {
        try {
            engine.call(call, args, attached);
        } catch (error) {
            return error.message;
        }
        return "";
    };
    expect(/unobtainium/.test(refusal("set", { settings: ["material=\"unobtainium\""] })),
           "an unknown material is named");
    expect(/no panorama|broken/.test(refusal("panorama", { name: "x.jpg" }, "none")),
           "what is no picture is refused");
    expect(/culet-view-1|broken/.test(refusal("open", {}, "{}")), "what is no document is refused");
    const cut = engine.call("cut", { kind: "round-brilliant", values: { table: 60 } });
    expect(cut.summary.facets.length > 50, "a cut is made");
    expect(engine.call("draw", cases[0].draw).beams > 100, "and drawn");
    const paths = engine.call("path", { width: 200, height: 200, x: 90.5, y: 95.5 });
    const sum = paths.paths.reduce((total, one) => total + one.weight,
                                   paths.remainder + paths.absorbed + paths.cut);
    expect(Math.abs(sum - 1) < 1e-12, `weights and losses of light paths are 1, found ${sum}`);
    process.exit(failures === 0 ? 0 : 1);
}

main();
