// A program of the book as its page runs it, in node: its output, errors and exit status; memory on the last line of
// standard error. Run: run_program.mjs PARTS PROGRAM OPTIONS...     PARTS: build/book-parts, with the module and the meshes
import { readFileSync, readdirSync } from "node:fs";
import "../../tutorials/book/live/system.js";

const { System, Files, where } = globalThis.antilockSystem, files = new Files();
const [parts, ...args] = process.argv.slice(2);
for (const name of readdirSync(`${parts}/meshes`)) files.write(`${where}/${name}`, new Uint8Array(readFileSync(`${parts}/meshes/${name}`)));
const system = new System({ args, files, print: (text, isError) => (isError ? process.stderr : process.stdout).write(text) });
const instance = await WebAssembly.instantiate(await WebAssembly.compile(readFileSync(`${parts}/programs.wasm`)), { wasi_snapshot_preview1: system.imports() });
process.exitCode = system.start(instance);
process.stderr.write(`${(instance.exports.memory.buffer.byteLength / 2 ** 20).toFixed(0)} MiB\n`);
