// What the library and its programs ask of a system: arguments, a clock, somewhere to print, files in memory. WASI
// preview 1, as far as they go; everything else is answered with "not here" (52). The page, its workers and node use it.
"use strict";
globalThis.antilockSystem = (() => {
const where = "/meshes";
const errors = { ok: 0, badf: 8, exist: 20, inval: 28, isdir: 31, noent: 44, notdir: 54, notempty: 55, nosys: 52, perm: 63 };

class Exit extends Error {
  constructor(status) { super(`exit ${status}`); this.status = status; }
}

class Files {
  constructor() { this.root = { entries: new Map() }; }
  /// The folder and the last name of a path.
  place(path) {
    const names = path.split("/").filter((name) => name && name !== ".");
    const last = names.pop() ?? "";
    let folder = this.root;
    for (const name of names) {
      folder = folder?.entries?.get(name);
      if (!folder?.entries) return {};
    }
    return { folder, last };
  }
  find(path) {
    const { folder, last } = this.place(path);
    return last === "" ? folder : folder?.entries.get(last);
  }
  makeFolder(path) {
    let folder = this.root;
    for (const name of path.split("/").filter(Boolean)) {
      if (!folder.entries.has(name)) folder.entries.set(name, { entries: new Map() });
      folder = folder.entries.get(name);
    }
    return folder;
  }
  write(path, bytes) {
    const at = path.lastIndexOf("/");
    this.makeFolder(path.slice(0, Math.max(0, at))).entries.set(path.slice(at + 1), { bytes, size: bytes.length });
  }
  /// [path, bytes] of every file below a folder.
  *all(path = "", folder = this.root) {
    for (const [name, node] of folder.entries)
      if (node.entries) yield* this.all(`${path}/${name}`, node);
      else yield [`${path}/${name}`, node.bytes.subarray(0, node.size)];
  }
}

/// A program's system. `print(text, isError)` is called with what it prints, line by line or when it flushes.
class System {
  constructor({ args = [], files = new Files(), print = () => {} }) {
    Object.assign(this, { args, files, print });
    this.open = [null, null, null, { node: files.root, at: 0 }];  // stdin, stdout, stderr, the folder "/"
    this.decoders = [null, new TextDecoder(), new TextDecoder()];
  }
  imports() {
    const calls = {};
    for (const name of Object.getOwnPropertyNames(System.prototype))
      if (/^(args|environ|clock|fd|path|poll|proc|random|sched|sock)_/.test(name)) calls[name] = this[name].bind(this);
    return new Proxy(calls, { get: (all, name) => all[name] ?? (() => errors.nosys), has: () => true });
  }
  /// Runs `_start` of an instance; its exit status.
  start({ exports }) {
    this.memory = exports.memory;
    try { exports._start(); } catch (end) {
      if (!(end instanceof Exit)) throw end;
      return end.status;
    }
    return 0;
  }
  get view() { return new DataView(this.memory.buffer); }
  get bytes() { return new Uint8Array(this.memory.buffer); }
  text(at, length) { return new TextDecoder().decode(this.bytes.slice(at, at + length)); }
  set32(at, value) { this.view.setUint32(at, value, true); }
  set64(at, value) { this.view.setBigUint64(at, BigInt(Math.round(value)), true); }

  list(all, pointers, texts) {
    for (const one of all) {
      const bytes = new TextEncoder().encode(`${one}\0`);
      this.set32(pointers, texts);
      this.bytes.set(bytes, texts);
      pointers += 4;
      texts += bytes.length;
    }
    return 0;
  }
  sizes(all, count, size) {
    this.set32(count, all.length);
    this.set32(size, all.reduce((sum, one) => sum + new TextEncoder().encode(one).length + 1, 0));
    return 0;
  }
  get variables() { return [`ANTILOCK_MESHES=${where}`]; }
  args_get(pointers, texts) { return this.list(this.args, pointers, texts); }
  args_sizes_get(count, size) { return this.sizes(this.args, count, size); }
  environ_get(pointers, texts) { return this.list(this.variables, pointers, texts); }
  environ_sizes_get(count, size) { return this.sizes(this.variables, count, size); }

  clock_time_get(clock, precision, at) {
    this.set64(at, (clock === 0 ? Date.now() : performance.now()) * 1e6);
    return 0;
  }
  random_get(at, length) {
    for (let i = 0; i < length; ++i) this.bytes[at + i] = 37 * i;  // nothing here is secret, and every run is the same
    return 0;
  }
  proc_exit(status) { throw new Exit(status); }

  fd_prestat_get(fd, at) {
    if (fd !== 3) return errors.badf;
    this.set32(at, 0);
    this.set32(at + 4, 1);
    return 0;
  }
  fd_prestat_dir_name(fd, at) { this.bytes[at] = "/".charCodeAt(0); return 0; }
  stat(node, at) {
    this.bytes.fill(0, at, at + 64);
    this.bytes[at + 16] = node ? (node.entries ? 3 : 4) : 2;  // a folder, a file, a terminal
    this.set64(at + 32, node?.size ?? 0);
    return 0;
  }
  fd_fdstat_get(fd, at) {
    const one = this.open[fd];
    if (fd > 2 && !one) return errors.badf;
    this.bytes.fill(0, at, at + 24);
    this.bytes[at] = fd < 3 ? 2 : one.node.entries ? 3 : 4;
    this.view.setBigUint64(at + 8, ~0n, true);
    this.view.setBigUint64(at + 16, ~0n, true);
    return 0;
  }
  fd_fdstat_set_flags() { return 0; }
  fd_filestat_get(fd, at) { return fd > 2 && !this.open[fd] ? errors.badf : this.stat(this.open[fd]?.node, at); }
  path_filestat_get(fd, flags, path, length, at) {
    const node = this.files.find(this.text(path, length));
    return node ? this.stat(node, at) : errors.noent;
  }
  path_open(fd, lookup, path, length, how, rights, inherited, flags, at) {
    const name = this.text(path, length), { folder, last } = this.files.place(name);
    if (!folder) return errors.noent;
    let node = last === "" ? folder : folder.entries.get(last);
    if (!node) {
      if (!(how & 1)) return errors.noent;  // to be created
      folder.entries.set(last, node = { bytes: new Uint8Array(1024), size: 0 });
    } else if ((how & 5) === 5) {
      return errors.exist;
    } else if (node.entries && (how & 8)) {
      return errors.isdir;
    } else if (!node.entries && (how & 2)) {
      return errors.notdir;
    } else if (how & 8) {
      node.size = 0;
    }
    this.set32(at, this.open.push({ node, at: 0, append: (flags & 1) !== 0 }) - 1);
    return 0;
  }
  fd_close(fd) { this.open[fd] = undefined; return 0; }
  fd_seek(fd, offset, whence, at) {
    const one = this.open[fd];
    if (!one) return fd < 3 ? 70 : errors.badf;
    one.at = Number(offset) + (whence === 0 ? 0 : whence === 1 ? one.at : one.node.size);
    this.set64(at, one.at);
    return 0;
  }
  *parts(list, count) {
    for (let i = 0; i < count; ++i) yield [this.view.getUint32(list + 8 * i, true), this.view.getUint32(list + 8 * i + 4, true)];
  }
  fd_write(fd, list, count, at) {
    let written = 0;
    const one = this.open[fd];
    if (fd > 2 && !one?.node.bytes) return errors.badf;
    for (const [from, length] of this.parts(list, count)) {
      const bytes = this.bytes.subarray(from, from + length);
      written += length;
      if (fd < 3) { this.print(this.decoders[fd].decode(bytes.slice(), { stream: true }), fd === 2); continue; }
      const node = one.node, begin = one.append ? node.size : one.at, end = begin + length;
      if (end > node.bytes.length) {
        const more = new Uint8Array(Math.max(end, 2 * node.bytes.length));
        more.set(node.bytes.subarray(0, node.size));
        node.bytes = more;
      }
      node.bytes.set(bytes, begin);
      node.size = Math.max(node.size, end);
      one.at = end;
    }
    this.set32(at, written);
    return 0;
  }
  fd_read(fd, list, count, at) {
    let read = 0;
    const one = this.open[fd];
    if (fd > 2 && !one) return errors.badf;
    for (const [to, length] of this.parts(list, count)) {
      if (!one) break;
      const some = one.node.bytes.subarray(one.at, Math.min(one.node.size, one.at + length));
      this.bytes.set(some, to);
      one.at += some.length;
      read += some.length;
    }
    this.set32(at, read);
    return 0;
  }
  fd_readdir(fd, at, room, cookie, used) {
    const names = [...this.open[fd].node.entries], start = at, end = at + room;
    for (let i = Number(cookie); i < names.length && at < end; ++i) {
      const name = new TextEncoder().encode(names[i][0]), head = new ArrayBuffer(24), view = new DataView(head);
      view.setBigUint64(0, BigInt(i + 1), true);
      view.setBigUint64(8, BigInt(i + 1), true);
      view.setUint32(16, name.length, true);
      view.setUint8(20, names[i][1].entries ? 3 : 4);
      for (const part of [new Uint8Array(head), name]) {
        const some = part.subarray(0, Math.max(0, end - at));
        this.bytes.set(some, at);
        at += some.length;
      }
    }
    this.set32(used, at - start);
    return 0;
  }
  path_create_directory(fd, path, length) {
    const { folder, last } = this.files.place(this.text(path, length));
    if (!folder) return errors.noent;
    if (last === "" || folder.entries.has(last)) return errors.exist;
    folder.entries.set(last, { entries: new Map() });
    return 0;
  }
  remove(path, length, wantsFolder) {
    const { folder, last } = this.files.place(this.text(path, length)), node = folder?.entries.get(last);
    if (!node) return errors.noent;
    if (wantsFolder && !node.entries) return errors.notdir;
    if (!wantsFolder && node.entries) return errors.isdir;
    if (node.entries?.size) return errors.notempty;
    folder.entries.delete(last);
    return 0;
  }
  path_unlink_file(fd, path, length) { return this.remove(path, length, false); }
  path_remove_directory(fd, path, length) { return this.remove(path, length, true); }
  path_rename(fd, path, length, toFd, to, toLength) {
    const from = this.files.place(this.text(path, length)), target = this.files.place(this.text(to, toLength));
    const node = from.folder?.entries.get(from.last);
    if (!node || !target.folder) return errors.noent;
    from.folder.entries.delete(from.last);
    target.folder.entries.set(target.last, node);
    return 0;
  }
}

/// What wasm/pack wrote: gzip, fifteen bits per character from U+3400 on; the first one counts the bytes too many.
async function unpacked(text) {
  const first = 0x3400, packed = new Uint8Array(15 * (text.length - 1) / 8);
  for (let i = 1, at = 0, bits = 0, have = 0; i < text.length; ++i) {
    bits = (bits << 15) | (text.charCodeAt(i) - first);
    for (have += 15; have >= 8;) packed[at++] = bits >> (have -= 8);
    bits &= (1 << have) - 1;
  }
  const zipped = new Blob([packed.subarray(0, packed.length - (text.charCodeAt(0) - first))]);
  return new Uint8Array(await new Response(zipped.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
}

/// A mesh as the library keeps it from what wasm/pack made of it: its coordinates byte by byte, its cells as differences.
function mesh(name, bytes) {
  const d = name.startsWith("tetrahedra") ? 3 : 2, corners = name.startsWith("unstructured") ? 3 : 4;
  const view = new DataView(bytes.buffer), [vertices, cells] = [0, 8].map((at) => view.getUint32(at, true));
  const begin = 16, end = begin + 8 * d * vertices, planes = bytes.slice(begin, end), step = d * vertices;
  for (let i = 0; i < step; ++i) for (let k = 0; k < 8; ++k) bytes[begin + 8 * i + k] = planes[k * step + i];
  for (let t = 0, first = 0; t < cells; ++t)
    for (let k = 0, v = first; k < corners; ++k) {
      const at = end + 4 * (corners * t + k);
      v += view.getInt32(at, true);
      if (k === 0) first = v;
      view.setInt32(at, v, true);
    }
  return bytes;
}

/// Puts packed meshes where the library looks for those that were kept (ANTILOCK_MESHES): per mesh the lengths of its name
/// and of its bytes, then both.
async function putMeshes(files, text) {
  const bytes = await unpacked(text), view = new DataView(bytes.buffer);
  for (let at = 0; at < bytes.length;) {
    const name = at + 8, begin = name + view.getUint32(at, true), end = begin + view.getUint32(at + 4, true);
    if (end > bytes.length) throw new Error("the page's meshes are damaged");
    const mesh_name = new TextDecoder().decode(bytes.subarray(name, begin));
    files.write(`${where}/${mesh_name}`, mesh(mesh_name, bytes.slice(begin, end)));
    at = end;
  }
}

return { System, Files, unpacked, putMeshes, where };
})();
