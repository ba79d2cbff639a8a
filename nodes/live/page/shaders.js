// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Shaders. Lines are rectangles with a width in pixels. The sides of a line fade over one pixel. Faces are
// more opaque at grazing view angles, so that round volumes have an outline.

export const POINT_VERTEX = `#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in vec3 position;
layout(location = 1) in uint label;
layout(location = 2) in float intensity;
uniform mat4 matrix;
uniform vec3 shift;           // from the points' origin to the scene's origin
uniform vec3 up;
uniform vec2 range;           // minimum and maximum of the height or the intensity
uniform vec3 ramp[5];
uniform vec3 plain;
uniform int mode;             // 0: by object, 1: by height, 2: by intensity
uniform int objects;          // colours in the texture
uniform float size;
uniform highp sampler2D colours;
out vec3 colour;

vec3 onRamp(float value) {
  float at = clamp((value - range.x) / max(range.y - range.x, 1e-9), 0.0, 1.0) * 4.0;
  int below = min(int(at), 3);
  return mix(ramp[below], ramp[below + 1], at - float(below));
}

void main() {
  vec3 p = position + shift;
  gl_Position = matrix * vec4(p, 1.0);
  gl_PointSize = size;
  bool isObject = label < uint(objects);
  if (mode == 1) {
    colour = onRamp(dot(p, up));
  } else if (mode == 2) {
    colour = onRamp(intensity);
  } else if (isObject) {
    colour = texelFetch(colours, ivec2(int(label) & 1023, int(label) >> 10), 0).rgb;
    gl_PointSize = size + 0.5;
  } else {
    colour = plain;
  }
}`;

export const POINT_FRAGMENT = `#version 300 es
precision highp float;
in vec3 colour;
out vec4 pixel;
void main() {
  pixel = vec4(colour, 1.0);
}`;

export const LINE_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec4 colour;
uniform mat4 matrix;
uniform vec2 viewport;        // in pixels
uniform float width;          // in pixels
out vec4 lineColour;
out float side;

void main() {
  vec4 from = matrix * vec4(a, 1.0);
  vec4 to = matrix * vec4(b, 1.0);
  // If an end point is behind the eye, move it along the line to just before the eye.
  float nearest = 1e-4;
  if (from.w < nearest && to.w > nearest) from = mix(from, to, (nearest - from.w) / (to.w - from.w));
  if (to.w < nearest && from.w > nearest) to = mix(to, from, (nearest - to.w) / (from.w - to.w));
  vec2 direction = (to.xy / to.w - from.xy / from.w) * viewport;
  float length2 = dot(direction, direction);
  // Draw a short line as a square of the line width, and a single point (a == b) as a square of twice the
  // width.
  bool isDot = length2 < 1e-3;
  direction = isDot ? vec2(1.0, 0.0) : direction * inversesqrt(length2);
  float half_ = (width + 1.0) * (a == b ? 2.0 : 1.0) / 2.0;
  float end = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  side = (gl_VertexID & 2) == 0 ? -1.0 : 1.0;
  vec4 at = end < 0.0 ? from : to;
  vec2 offset = vec2(-direction.y, direction.x) * side * half_ + direction * end * (isDot ? half_ : 0.0);
  gl_Position = at + vec4(2.0 * offset / viewport * at.w, 0.0, 0.0);
  side *= (width + 1.0) / 2.0;
  lineColour = colour;
}`;

export const LINE_FRAGMENT = `#version 300 es
precision highp float;
in vec4 lineColour;
in float side;
uniform float width;
out vec4 pixel;
void main() {
  float cover = clamp((width + 1.0) / 2.0 - abs(side), 0.0, 1.0);
  pixel = vec4(lineColour.rgb, lineColour.a * cover);
}`;

export const FACE_VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 matrix;
uniform vec3 eye;
out vec4 faceColour;
out vec3 faceNormal;
out vec3 toEye;
void main() {
  gl_Position = matrix * vec4(position, 1.0);
  faceColour = colour;
  faceNormal = normal;
  toEye = eye - position;
}`;

export const FACE_FRAGMENT = `#version 300 es
precision highp float;
in vec4 faceColour;
in vec3 faceNormal;
in vec3 toEye;
out vec4 pixel;
void main() {
  float size = length(faceNormal);  // 0: the volume is flat and has no normal here
  float rim = size > 0.0 ? 1.0 - abs(dot(faceNormal, normalize(toEye))) / size : 0.0;
  pixel = vec4(faceColour.rgb, faceColour.a * (0.6 + 1.6 * rim * rim * rim));
}`;
