// One run of one program. Beside it, in the same source, stands system.js.
"use strict";
onmessage = async ({ data: { packed, ready, args, put } }) => {
  const { System, Files, unpacked, putMeshes, where } = globalThis.antilockSystem;
  let status = null, trouble = "", memory = 0, files = new Files(), began = performance.now();
  try {
    if (packed) {  // the first run unpacks for all that follow
      ready = { files };
      for (const meshes of packed.meshes) await putMeshes(files, meshes);
      ready.module = await WebAssembly.compile(await unpacked(packed.wasm));
      postMessage({ ready });
    }
    files = Object.assign(new Files(), ready.files);
    for (const [path, text] of put) files.write(path, typeof text === "string" ? new TextEncoder().encode(text) : text);
    const system = new System({ args, files, print: (text, isError) => postMessage({ text, isError }) });
    const instance = await WebAssembly.instantiate(ready.module, { wasi_snapshot_preview1: system.imports() });
    postMessage({ started: true });
    began = performance.now();
    status = system.start(instance);
    memory = instance.exports.memory.buffer.byteLength;
  } catch (error) { trouble = String(error); }
  const results = [...files.all()].filter(([path]) => !path.startsWith(where) && !put.some(([name]) => name === path));
  postMessage({ end: true, status, trouble, memory, seconds: (performance.now() - began) / 1e3, results });
};
