// The playground: a scene in TOML, answered by run_scene in the page. The scene travels in the page's address, after #.
"use strict";
antilock.playground = (box, run) => {
  const at = (id) => document.getElementById(id), scene = at("scene"), start = at("scene-start"), said = at("scene-said");
  const { scenes, meshes } = JSON.parse(at("scenes").textContent);  // meshes: by name, as text
  const own = {};                                                   // those of the reader
  start.append(...Object.keys(scenes).map((name) => new Option(name, name)));
  const begin = (name) => { scene.value = scenes[name]; start.value = name; };
  const fromAddress = () => {
    const text = new URLSearchParams(location.hash.slice(1)).get("scene");
    if (text) scene.value = text;
    return Boolean(text);
  };
  if (!fromAddress()) begin("figure8");
  start.addEventListener("input", () => begin(start.value));
  addEventListener("hashchange", fromAddress);
  const address = () => `#scene=${encodeURIComponent(scene.value)}`;

  async function take(files) {
    for (const file of files) {
      own[file.name] = new Uint8Array(await file.arrayBuffer());
      said.textContent = `${file.name} lies beside the scene now: kind = "file", file = "${file.name}"`;
    }
  }
  at("scene-mesh").addEventListener("input", (event) => take(event.target.files));
  scene.addEventListener("dragover", (event) => event.preventDefault());
  scene.addEventListener("drop", (event) => {
    if (!event.dataTransfer.files.length) return;
    event.preventDefault();
    take(event.dataTransfer.files);
  });
  at("scene-link").addEventListener("click", async () => {
    history.replaceState(null, "", address());
    try {
      await navigator.clipboard.writeText(location.href);
      said.textContent = "The address of this page with this scene is copied.";
    } catch { said.textContent = "The address of this page now holds this scene."; }
  });
  at("run-scene").disabled = false;
  at("run-scene").addEventListener("click", () => {
    history.replaceState(null, "", address());
    run(["scene.toml", "--out", "results"], [["/scene.toml", scene.value], ...Object.entries({ ...meshes, ...own }).map(([name, data]) => [`/${name}`, data])]);
  });
};
