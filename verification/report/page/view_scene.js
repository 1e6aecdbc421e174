// SPDX-License-Identifier: MIT
// A surface and its edges in WebGL, turned, moved and zoomed by pointer, fingers and keys. Parallel projection: lengths
// across the line of sight are true everywhere, as in the pictures.
"use strict";
class ViewScene {
  static VERTEX = `attribute vec3 place, normal, colour; uniform mat3 turn; uniform vec3 middle; uniform vec2 scale, shift;
    uniform float nearer, depth; varying vec3 tint; varying vec3 seen;
    void main() {
      vec3 p = turn * (place - middle);
      gl_Position = vec4(p.xy * scale + shift, -depth * p.z - nearer, 1.0);
      tint = colour; seen = turn * normal;
    }`;
  static FRAGMENT = `precision mediump float; varying vec3 tint; varying vec3 seen; uniform float contrast;
    void main() {
      vec3 n = length(seen) > 0.0 ? normalize(seen) : vec3(0.0, 0.0, 1.0);
      if (n.z < 0.0) n = -n;
      float lamp = max(dot(n, normalize(vec3(-0.35, 0.45, 0.82))), 0.0);
      gl_FragColor = vec4(tint * (1.0 - contrast * (0.56 - 0.43 * lamp - 0.13 * n.z)), 1.0);
    }`;

  // @throws where the browser has no WebGL
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("this browser has no WebGL");
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, ViewScene.VERTEX], [gl.FRAGMENT_SHADER, ViewScene.FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    this.program = program;
    this.uniform = (name) => gl.getUniformLocation(program, name);
    this.buffers = Object.fromEntries(["place", "normal", "colour", "edge"].map((name) => [name, gl.createBuffer()]));
    this.corners = this.edge_ends = 0;
    this.middle = [0, 0, 0];
    this.size = 1;
    this.contrast = 1;
    this.home = { yaw: 0, pitch: 0, zoom: 1, shift: [0, 0] };
    this.reset();
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  reset() {
    Object.assign(this, this.home, { shift: [...this.home.shift] });
  }

  fill(name, values) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
  }

  // @param points (n*3) [m] @param triangles (m*3) @param colour_of (corner k of triangle t, vertex) -> [r, g, b] from 0 to 1
  surface(points, triangles, colour_of) {
    const normals = new Float32Array(points.length), n = triangles.length;
    for (let t = 0; t < n; t += 3) {
      const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
      const u = [0, 1, 2].map((i) => points[b + i] - points[a + i]), v = [0, 1, 2].map((i) => points[c + i] - points[a + i]);
      const w = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const corner of [a, b, c]) for (let i = 0; i < 3; ++i) normals[corner + i] += w[i];
    }
    const place = new Float32Array(3 * n), normal = new Float32Array(3 * n), colour = new Float32Array(3 * n);
    for (let k = 0; k < n; ++k) {
      const vertex = triangles[k];
      place.set(points.subarray(3 * vertex, 3 * vertex + 3), 3 * k);
      normal.set(normals.subarray(3 * vertex, 3 * vertex + 3), 3 * k);
      colour.set(colour_of(Math.floor(k / 3), vertex), 3 * k);
    }
    this.fill("place", place);
    this.fill("normal", normal);
    this.fill("colour", colour);
    this.corners = n;
  }

  // Lines along all edges of triangles; none where there are no points.
  edges(points, triangles) {
    const ends = [];
    const seen = new Set();
    for (let t = 0; points && t < triangles.length; t += 3)
      for (const [i, j] of [[0, 1], [1, 2], [2, 0]]) {
        const [a, b] = [triangles[t + i], triangles[t + j]].sort((p, q) => p - q);
        if (seen.has(a * 65536 + b)) continue;
        seen.add(a * 65536 + b);
        ends.push(...points.subarray(3 * a, 3 * a + 3), ...points.subarray(3 * b, 3 * b + 3));
      }
    this.fill("edge", new Float32Array(ends));
    this.edge_ends = ends.length / 3;
  }

  // Bounds of all that will be shown, so that the camera stays while it moves.
  look_at(low, high) {
    this.middle = low.map((value, i) => 0.5 * (value + high[i]));
    this.size = Math.hypot(...low.map((value, i) => high[i] - value)) || 1;
  }

  draw() {
    const { gl, canvas } = this, ratio = Math.min(2, devicePixelRatio || 1);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const shorter = Math.min(canvas.width, canvas.height), zoom = 2.1 * this.zoom / this.size;
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    // Columns: first about the cloth's third axis, then towards the eye.
    gl.uniformMatrix3fv(this.uniform("turn"), false, [cy, sy * cp, sy * sp, -sy, cy * cp, cy * sp, 0, -sp, cp]);
    gl.uniform3fv(this.uniform("middle"), this.middle);
    gl.uniform2f(this.uniform("scale"), zoom * shorter / canvas.width, zoom * shorter / canvas.height);
    gl.uniform2fv(this.uniform("shift"), this.shift);
    gl.uniform1f(this.uniform("depth"), 0.9 / this.size);
    this.bind({ place: "place", normal: "normal", colour: "colour" });
    gl.uniform1f(this.uniform("contrast"), this.contrast);
    gl.uniform1f(this.uniform("nearer"), 0);
    if (this.corners) gl.drawArrays(gl.TRIANGLES, 0, this.corners);
    this.bind({ place: "edge" });
    gl.uniform1f(this.uniform("contrast"), 0);
    gl.uniform1f(this.uniform("nearer"), 0.004);
    if (this.edge_ends) gl.drawArrays(gl.LINES, 0, this.edge_ends);
    this.on_draw?.(0.5 * zoom * shorter / ratio);  // pixels of the page per metre
  }

  bind(names) {
    const gl = this.gl;
    for (const name of ["place", "normal", "colour"]) {
      const at = gl.getAttribLocation(this.program, name);
      if (!(name in names)) {
        gl.disableVertexAttribArray(at);
        gl.vertexAttrib3f(at, ...(name === "colour" ? this.edge_colour || [0.3, 0.3, 0.3] : [0, 0, 1]));
        continue;
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[names[name]]);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    }
  }

  listen() {
    const { canvas } = this, fingers = new Map();
    const zoom_by = (factor) => { this.zoom = Math.min(60, Math.max(0.2, this.zoom * factor)); };
    const turn_by = (x, y) => { this.yaw += x; this.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI, this.pitch + y)); };
    const move_by = (x, y) => { this.shift[0] += 2 * x / canvas.clientWidth; this.shift[1] -= 2 * y / canvas.clientHeight; };
    canvas.tabIndex = 0;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const now = [event.clientX, event.clientY], other = [...fingers].find(([id]) => id !== event.pointerId);
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      if (other) {
        const distance = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]) || 1;
        zoom_by(distance(now) / distance(before));
        move_by(dx / 2, dy / 2);
      } else if (event.shiftKey || event.buttons === 2) move_by(dx, dy);
      else turn_by(dx / 150, dy / 150);
      fingers.set(event.pointerId, now);
      this.draw();
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => { event.preventDefault(); zoom_by(Math.exp(-event.deltaY / 600)); this.draw(); },
      { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const acts = { ArrowLeft: () => turn_by(-0.1, 0), ArrowRight: () => turn_by(0.1, 0), ArrowUp: () => turn_by(0, -0.1),
        ArrowDown: () => turn_by(0, 0.1), "+": () => zoom_by(1.15), "-": () => zoom_by(1 / 1.15) };
      if (!acts[event.key]) return;
      event.preventDefault();
      acts[event.key]();
      this.draw();
    });
  }
}
