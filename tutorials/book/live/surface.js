// A surface over the domain, drawn by WebGL2, with axes and the exact ridge.
"use strict";
antilock.viridis = (t) => {  // a polynomial fit of matplotlib's map
  const c = [[0.2777, 0.0054, 0.3341], [0.1051, 1.4046, 1.3846], [-0.3309, 0.2148, 0.0951], [-4.6342, -5.7991, -19.3324],
    [6.2283, 14.1799, 56.6906], [4.7764, -13.7451, -65.3530], [-5.4355, 4.6459, 26.3124]];
  return [0, 1, 2].map((k) => Math.round(255 * Math.min(1, Math.max(0, c.reduceRight((sum, a) => sum * t + a[k], 0)))));
};

/// A mesh of the unit squares, from above: rows with the corners x0, y0, ... y2 and a number, which is the colour.
antilock.triangles = (canvas, rows) => {
  const paper = canvas.getContext("2d"), colours = rows.map((row) => row.colour), sorted = [...colours].sort((a, b) => a - b);
  const low = sorted[Math.floor(0.05 * sorted.length)], high = sorted.at(-1);
  const bottom = Math.min(...rows.map((row) => row.y0)), width = canvas.width;
  canvas.height = Math.round(width * (1 - bottom));
  paper.lineWidth = rows.length > 4000 ? 0.2 : 0.5;
  rows.forEach((row, i) => {
    paper.beginPath();
    for (const k of [0, 1, 2]) paper.lineTo(row[`x${k}`] * width, (1 - row[`y${k}`]) * width);
    paper.closePath();
    paper.fillStyle = `rgb(${antilock.viridis(Math.max(0, Math.min(1, (colours[i] - low) / (high - low)))).join(",")})`;
    paper.fill();
    paper.stroke();
  });
};

antilock.surface = (canvas, labels) => {
  // A point (x, y, u) in the picture; the same for the shader and for the labels.
  const vertexShader = `#version 300 es
    in vec3 corner;
    uniform vec2 turn;
    uniform float aspect, height;
    out vec3 place, side;
    out float u;
    void main() {
      vec3 p = vec3(corner.x - 0.5, 0.75 * corner.y, corner.z * height);
      float c = cos(turn.x), s = sin(turn.x), ct = cos(turn.y), st = sin(turn.y);
      vec3 q = vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
      vec3 v = vec3(q.x, ct * q.z + st * q.y, ct * q.y - st * q.z);
      place = v;
      u = corner.z;
      side = vec3(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1, gl_VertexID % 3 == 2);
      float zoom = 1.4 * min(1.0, aspect / 1.65);
      gl_Position = vec4(v.x / aspect * zoom, v.y * zoom - 0.02, v.z * 0.3, 1.0);
    }`;
  const fragmentShader = `#version 300 es
    precision highp float;
    in vec3 place, side;
    in float u;
    uniform float range;
    uniform vec4 plain;  // a colour of its own for lines; alpha 0: by u
    out vec4 colour;
    vec3 viridis(float t) {
      const vec3 a = vec3(0.2777, 0.0054, 0.3341), b = vec3(0.1051, 1.4046, 1.3846), c = vec3(-0.3309, 0.2148, 0.0951),
        d = vec3(-4.6342, -5.7991, -19.3324), e = vec3(6.2283, 14.1799, 56.6906), f = vec3(4.7764, -13.7451, -65.3530),
        g = vec3(-5.4355, 4.6459, 26.3124);
      return a + t * (b + t * (c + t * (d + t * (e + t * (f + t * g)))));
    }
    void main() {
      if (plain.a > 0.0) { colour = plain; return; }
      vec3 base = viridis(clamp(0.5 + 0.5 * u / range, 0.0, 1.0));
      vec3 n = normalize(cross(dFdx(place), dFdy(place)));
      float light = 0.7 + 0.3 * abs(dot(n, normalize(vec3(-0.3, 0.8, -0.5))));
      vec3 w = fwidth(side), e = smoothstep(vec3(0.0), 1.2 * w, side);
      float line = 1.0 - min(e.x, min(e.y, e.z));
      colour = vec4(mix(base * light, vec3(0.05), 0.45 * line), 1.0);
    }`;
  const height = 1.6;
  let gl, program, buffer, last;
  function prepare() {
    gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL2");
    program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);  // to ask before how its parts fared is to wait for each of them
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const corner = gl.getAttribLocation(program, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 3, gl.FLOAT, false, 0, 0);
    gl.enable(gl.DEPTH_TEST);
  }
  prepare();
  canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); labels.lost?.(true); });
  canvas.addEventListener("webglcontextrestored", () => { prepare(); labels.lost?.(false); if (last) draw(...last); });

  const onPage = ([x, y, z], turn, aspect) => {
    const p = [x - 0.5, 0.75 * y, z * height], c = Math.cos(turn[0]), s = Math.sin(turn[0]), ct = Math.cos(turn[1]), st = Math.sin(turn[1]);
    const q = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]], zoom = 1.4 * Math.min(1, aspect / 1.65);
    return [50 + 50 * (q[0] / aspect) * zoom, 50 - 50 * ((ct * q[2] + st * q[1]) * zoom - 0.02)];
  };

  function lines(points, mode, colour, uniform, lift = 0) {
    gl.uniform4f(uniform("plain"), ...colour);
    const data = new Float32Array(points);
    if (lift) for (let i = 2; i < data.length; i += 3) data[i] += lift;
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    gl.drawArrays(mode, 0, data.length / 3);
  }

  function draw(corners, ridge, range, turn) {
    last = [corners, ridge, range, turn];
    if (gl.isContextLost()) return;
    const scale = Math.min(window.devicePixelRatio || 1, 2), uniform = (name) => gl.getUniformLocation(program, name);
    canvas.width = canvas.clientWidth * scale;
    canvas.height = canvas.clientHeight * scale;
    const aspect = canvas.width / canvas.height;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform2f(uniform("turn"), ...turn);
    gl.uniform1f(uniform("height"), height);
    gl.uniform1f(uniform("range"), range);
    gl.uniform1f(uniform("aspect"), aspect);
    gl.uniform4f(uniform("plain"), 0, 0, 0, 0);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.DYNAMIC_DRAW);
    gl.drawArrays(gl.TRIANGLES, 0, corners.length / 3);
    // the outline of the domain at u = 0, Sigma, the axis of u; then the exact ridge, as a band of lines: it is 3 wide
    const grey = [0.5, 0.5, 0.5, 1];
    lines([0, -1, 0, 1, -1, 0, 1, -1, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, -1, -range, 0, -1, range], gl.LINES, grey, uniform);
    const red = [0.84, 0.15, 0.1, 1], path = [];
    for (let i = 0; i < ridge.length; i += 2) path.push(ridge[i], -1.001, ridge[i + 1]);
    for (const lift of [-0.004, -0.002, 0, 0.002, 0.004]) lines(path, gl.LINE_STRIP, red, uniform, lift);
    for (const [label, at] of labels.at) {
      const [x, y] = onPage(at(range), turn, aspect);
      label.style.left = `${x}%`;
      label.style.top = `${y}%`;
    }
  }
  return draw;
};

/// Turns a surface by dragging, or by the arrow keys: changes `turn`, and draws.
antilock.turns = (canvas, turn, draw) => {
  const turned = (dx, dy) => {
    turn[0] += dx;
    turn[1] = Math.min(1.5, Math.max(0.05, turn[1] + dy));
    draw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => event.buttons && turned(event.movementX / 150, event.movementY / 150));
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
    if (!step) return;
    event.preventDefault();
    turned(...step);
  });
};
