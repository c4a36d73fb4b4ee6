/** The cockpit by WebGL: every line and tube is a strip that faces the eye, all of them in one call. */
import * as twgl from "twgl.js";
import type { Position } from "../cabin.ts";
import { type Camera, FAR, NEAR } from "./camera.ts";
import { type Colour, dashes, faded, type Shapes, type View } from "./view.ts";

const DEPTH = `
  float depthAt(float depth) {
    float ndc = ${((FAR + NEAR) / (FAR - NEAR)).toFixed(6)} - ${((2 * FAR * NEAR) / (FAR - NEAR)).toFixed(4)} / depth;
    return 0.5 + 0.5 * ndc;
  }`;

/** A segment from one place to another; its radius is in mm, or negative: in px. Its ends are round, or where `cut` is 1 cut off. */
const STRIP = {
  vertex: `#version 300 es
  in vec2 corner;
  in vec3 a;
  in vec3 b;
  in float radius;
  in vec4 colour;
  in float cut;
  uniform mat4 matrix;
  uniform vec2 size;
  uniform float scale;
  out vec2 along;
  out float reach;
  out float depth;
  out float bulge;
  out vec4 paint;
  out float edge;
  void main() {
    vec4 from = matrix * vec4(a, 1.0);
    vec4 to = matrix * vec4(b, 1.0);
    vec2 p = from.xy / from.w * size * 0.5;
    vec2 q = to.xy / to.w * size * 0.5;
    depth = corner.x < 0.5 ? from.w : to.w;
    // in px, with one more for a soft edge
    float r = radius < 0.0 ? -radius : radius * scale / depth;
    float way = distance(p, q);
    vec2 ahead = way > 0.0001 ? (q - p) / way : vec2(1.0, 0.0);
    vec2 place = mix(p, q, corner.x) + (r + 1.0) * ((2.0 * corner.x - 1.0) * ahead + corner.y * vec2(-ahead.y, ahead.x));
    along = vec2(mix(-(r + 1.0), way + r + 1.0, corner.x), corner.y * (r + 1.0));
    reach = way;
    bulge = radius < 0.0 ? radius : r;
    paint = colour;
    edge = cut;
    // flat on the canvas: what is interpolated is interpolated there
    gl_Position = vec4(place / size * 2.0, 0.0, 1.0);
  }`,
  fragment: `#version 300 es
  precision highp float;
  in vec2 along;
  in float reach;
  in float depth;
  in float bulge;
  in vec4 paint;
  in float edge;
  uniform float scale;
  out vec4 colour;
  ${DEPTH}
  void main() {
    float r = abs(bulge);
    float beyond = along.x - clamp(along.x, 0.0, reach);
    float off = edge > 0.5 ? abs(along.y) : length(vec2(beyond, along.y));
    float cover = clamp(r - off + 0.5, 0.0, 1.0) * (edge > 0.5 && beyond != 0.0 ? 0.0 : 1.0);
    if (cover <= 0.0) discard;
    vec3 rgb = paint.rgb;
    float near = 0.0;
    if (bulge > 0.0) {
      float height = sqrt(max(0.0, 1.0 - off * off / (r * r)));
      rgb *= 0.5 + 0.5 * height;
      near = height * r * depth / scale;
    }
    gl_FragDepth = depthAt(depth - near);
    float alpha = paint.a * cover;
    colour = vec4(rgb * alpha, alpha);
  }`,
};

/** A patch or, where `fall` is 1, light that falls off from its middle. */
const SURFACE = {
  vertex: `#version 300 es
  in vec3 place;
  in vec2 local;
  in vec4 colour;
  in float fall;
  uniform mat4 matrix;
  out vec2 from;
  out vec4 paint;
  out float falling;
  void main() {
    from = local;
    paint = colour;
    falling = fall;
    gl_Position = matrix * vec4(place, 1.0);
  }`,
  fragment: `#version 300 es
  precision highp float;
  in vec2 from;
  in vec4 paint;
  in float falling;
  out vec4 colour;
  void main() {
    float share = max(0.0, 1.0 - length(from));
    float alpha = paint.a * mix(1.0, share * share * (0.75 + 0.25 * share), falling);
    colour = vec4(paint.rgb * alpha, alpha);
  }`,
};

/** Numbers for a segment, and for a corner of a surface. */
const SEGMENT = 12;
const CORNER = 10;
const BYTES = Float32Array.BYTES_PER_ELEMENT;

export class WebglView implements View {
  readonly kind = "webgl";
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #strips: twgl.ProgramInfo;
  readonly #surfaces: twgl.ProgramInfo;
  readonly #segments: WebGLBuffer;
  readonly #corners: WebGLBuffer;
  readonly #stripArray: twgl.VertexArrayInfo;
  readonly #surfaceArray: twgl.VertexArrayInfo;
  #ratio = 1;

  constructor(canvas: HTMLCanvasElement, gl: WebGL2RenderingContext) {
    this.#canvas = canvas;
    this.#gl = gl;
    this.#strips = twgl.createProgramInfo(gl, [STRIP.vertex, STRIP.fragment]);
    this.#surfaces = twgl.createProgramInfo(gl, [SURFACE.vertex, SURFACE.fragment]);
    this.#segments = twgl.createBufferFromTypedArray(gl, new Float32Array(0), gl.ARRAY_BUFFER, gl.DYNAMIC_DRAW);
    this.#corners = twgl.createBufferFromTypedArray(gl, new Float32Array(0), gl.ARRAY_BUFFER, gl.DYNAMIC_DRAW);
    const each = (numComponents: number, at: number) => ({
      buffer: this.#segments,
      numComponents,
      stride: SEGMENT * BYTES,
      offset: at * BYTES,
      divisor: 1,
    });
    const strip = twgl.createBufferInfoFromArrays(gl, {
      corner: { numComponents: 2, data: [0, -1, 1, -1, 0, 1, 1, 1] },
      a: each(3, 0),
      b: each(3, 3),
      radius: each(1, 6),
      colour: each(4, 7),
      cut: each(1, 11),
    });
    this.#stripArray = twgl.createVertexArrayInfo(gl, this.#strips, strip);
    const corner = (numComponents: number, at: number) => ({
      buffer: this.#corners,
      numComponents,
      stride: CORNER * BYTES,
      offset: at * BYTES,
    });
    const surface = twgl.createBufferInfoFromArrays(gl, {
      place: corner(3, 0),
      local: corner(2, 3),
      colour: corner(4, 5),
      fall: corner(1, 9),
    });
    this.#surfaceArray = twgl.createVertexArrayInfo(gl, this.#surfaces, surface);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.clearColor(0, 0, 0, 0);
  }

  resize(width: number, height: number, ratio: number): void {
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    this.#ratio = ratio;
  }

  draw({ patches, glows, marks, tubes, lines }: Shapes, camera: Camera): void {
    const gl = this.#gl;
    const { width, height } = this.#canvas;
    const uniforms = { matrix: camera.matrix(), size: [width, height], scale: camera.scale(1) * this.#ratio };
    gl.viewport(0, 0, width, height);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const drawSurfaces = (numbers: number[]) => {
      if (numbers.length > 0) this.#draw(this.#surfaces, this.#surfaceArray, this.#corners, numbers, uniforms, CORNER);
    };
    const drawStrips = (numbers: number[]) => {
      if (numbers.length > 0) this.#draw(this.#strips, this.#stripArray, this.#segments, numbers, uniforms, SEGMENT);
    };
    drawSurfaces(patches.flatMap(({ corners, colour }) => fan(corners, colour)));
    drawStrips(tubes.flatMap(({ points, radius, colour }) => segments(points, radius, false, () => colour)));
    // what lets through hides nothing
    gl.depthMask(false);
    drawSurfaces(glows.flatMap(({ centre, radius, colour }) => square(centre, radius, colour)));
    drawStrips(
      [...marks, ...lines].flatMap((line) => {
        const { colour, from = 1 } = line;
        const radius = (-line.width / 2) * this.#ratio;
        return dashes(line).flatMap((points) =>
          segments(points, radius, line.from !== undefined, (share) => faded(colour, from + (1 - from) * share)),
        );
      }),
    );
  }

  free(): void {
    this.#gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  #draw(
    program: twgl.ProgramInfo,
    array: twgl.VertexArrayInfo,
    buffer: WebGLBuffer,
    numbers: number[],
    uniforms: Record<string, unknown>,
    size: number,
  ): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(numbers), gl.DYNAMIC_DRAW);
    gl.useProgram(program.program);
    twgl.setUniforms(program, uniforms);
    gl.bindVertexArray(array.vertexArrayObject ?? null);
    const count = numbers.length / size;
    if (size === SEGMENT) gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    else gl.drawArrays(gl.TRIANGLES, 0, count);
    gl.bindVertexArray(null);
  }
}

function paint([red, green, blue, alpha]: Colour): number[] {
  return [red / 255, green / 255, blue / 255, alpha];
}

/** From each point to the next; `colourAt` is asked at the share of the way. */
function segments(points: readonly Position[], radius: number, cut: boolean, colourAt: (share: number) => Colour): number[] {
  const last = points.length - 1;
  return points
    .slice(1)
    .flatMap((point, k) => [...(points[k] as Position), ...point, radius, ...paint(colourAt((k + 1) / last)), Number(cut)]);
}

/** Triangles from the first corner to all others. */
function fan(corners: readonly Position[], colour: Colour): number[] {
  const at = (corner: Position) => [...corner, 0, 0, ...paint(colour), 0];
  const [first, ...rest] = corners.map(at);
  return rest.slice(1).flatMap((corner, k) => [...(first as number[]), ...(rest[k] as number[]), ...corner]);
}

/** Two triangles on the screen's plane. */
function square([x, y, z]: Position, radius: number, colour: Colour): number[] {
  const at = (right: number, down: number) => [x + right * radius, y + down * radius, z, right, down, ...paint(colour), 1];
  return [at(-1, -1), at(1, -1), at(1, 1), at(-1, -1), at(1, 1), at(-1, 1)].flat();
}
