// The Khronos validator over what culet writes: validate_gltf.js CULET VALIDATOR SAMPLES. No error and no
// warning is the expectation: its rules are the standard's.
const { execFileSync } = require("child_process");
const fs = require("fs"), os = require("os"), path = require("path");
const [culet, validatorFolder, samples] = process.argv.slice(2);
const validator = require(validatorFolder);
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "culet-gltf-"));
const stones = [
  ["dravite-step/hand.obj", ["--material", "tourmaline_dravite"]], ["effects/step.obj", ["--material", "sapphire_blue"]],
  ["studies/brilliant.obj", ["--material", "diamond"]], ["instruments/oval.obj", []],
  ["cutters-evening/mended.toml", []],
];
(async () => {
  let faults = 0;
  for (const [file, options] of stones) {
    for (const extension of ["glb", "gltf"]) {
      const written = path.join(folder, `stone.${extension}`);
      execFileSync(culet, ["convert", "-q", path.join(samples, file), written, ...options], { stdio: "inherit" });
      const found = await validator.validateBytes(new Uint8Array(fs.readFileSync(written)));
      const { numErrors, numWarnings, messages } = found.issues;
      console.log(`${file} as ${extension}: ${numErrors} errors, ${numWarnings} warnings`);
      for (const message of messages) console.log(`  ${message.code} ${message.pointer}: ${message.message}`);
      faults += numErrors + numWarnings;
    }
  }
  fs.rmSync(folder, { recursive: true });
  process.exit(faults === 0 ? 0 : 1);
})();
