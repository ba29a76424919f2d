// Programs of the book as their pages run them, in node, one after the other: their module is compiled once for all.
// Run: run_programs.mjs PARTS     PARTS: build/book-parts, with the scripts of the pages
// Each line that comes in is a JSON list, a program and its options; the line that answers it is
// {"status": exit status, "out": what it printed, "errors": what it printed as errors, "MiB": memory}.
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import "../../tutorials/book/live/system.js";

const { System, Files, unpacked, putMeshes } = globalThis.antilockSystem, kept = new Files(), window = {};
for (const name of ["meshes", "programs"])
  new Function("window", readFileSync(`${process.argv[2]}/static/${name}_data.js`, "utf16le").slice(1))(window);
await putMeshes(kept, window.ANTILOCK_MESHES.packed);
await putMeshes(kept, window.ANTILOCK_PROGRAMS.meshes);
const module = await WebAssembly.compile(await unpacked(window.ANTILOCK_PROGRAMS.wasm));
for await (const line of createInterface({ input: process.stdin })) {
  const said = { out: "", errors: "" }, files = Object.assign(new Files(), structuredClone(kept));  // each has files of its own
  const system = new System({ args: JSON.parse(line), files, print: (text, isError) => { said[isError ? "errors" : "out"] += text; } });
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: system.imports() });
  said.status = system.start(instance);
  said.MiB = Math.round(instance.exports.memory.buffer.byteLength / 2 ** 20);
  console.log(JSON.stringify(said));
}
