// A program of the book as its page runs it, in node: its output, errors and exit status; memory on the last line of
// standard error. Run: run_program.mjs PARTS PROGRAM OPTIONS...     PARTS: build/book-parts, with the scripts of the pages
import { readFileSync } from "node:fs";
import "../../tutorials/book/live/system.js";

const { System, Files, unpacked, putMeshes } = globalThis.antilockSystem, files = new Files(), window = {};
const [parts, ...args] = process.argv.slice(2);
for (const name of ["meshes", "programs"])
  new Function("window", readFileSync(`${parts}/static/${name}_data.js`, "utf16le").slice(1))(window);
await putMeshes(files, window.ANTILOCK_MESHES.packed);
await putMeshes(files, window.ANTILOCK_PROGRAMS.meshes);
const system = new System({ args, files, print: (text, isError) => (isError ? process.stderr : process.stdout).write(text) });
const instance = await WebAssembly.instantiate(await WebAssembly.compile(await unpacked(window.ANTILOCK_PROGRAMS.wasm)), { wasi_snapshot_preview1: system.imports() });
process.exitCode = system.start(instance);
process.stderr.write(`${(instance.exports.memory.buffer.byteLength / 2 ** 20).toFixed(0)} MiB\n`);
