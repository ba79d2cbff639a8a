// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sort keys of points: their position along a Morton curve through a box around the cloud (Lauterbach et
// al. 2009). The axis with the longest cells is halved first, so a flat cloud gets few bits for its height.
// The order only decides how fast queries are, so rounding does not matter.
#version 450

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStride = 3;  // words from one point to the next

layout(std430, binding = 0) readonly buffer Points { uint words[]; };
layout(std430, binding = 1) writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 2) writeonly buffer Numbers { uint numbers[]; };
layout(push_constant) uniform Part {
  float low_x, low_y, low_z;        // lower corner of the box; points outside count as points on its sides
  float scale_x, scale_y, scale_z;  // cells per unit of length
  uint bits_x, bits_y, bits_z;      // 2^bits cells along each axis
  uint axes_first, axes_last;       // the axis of each bit, 2 bits each: the first 16 and the others
  uint first_word;                  // of the first point in `words`
  uint points;
  uint invalid_key;  // key of a point without finite coordinates; above all other keys
};

const uint kPointsPerGroup = 1024;
const uint kThreads = 64;

uint cell(float x, float low, float scale, uint bits) {
  const float most = float((1u << bits) - 1u);
  return min(uint(clamp((x - low) * scale, 0.0, most)), (1u << bits) - 1u);
}

uint interleaved(uvec3 cells) {
  uvec3 left = uvec3(bits_x, bits_y, bits_z);
  const uint bits = bits_x + bits_y + bits_z;
  uint code = 0;
  for (uint b = 0; b < bits; ++b) {
    const uint axis = ((b < 16 ? axes_first : axes_last) >> (2 * (b & 15u))) & 3u;
    --left[axis];
    code = 2 * code + ((cells[axis] >> left[axis]) & 1u);
  }
  return code;
}

void main() {
  const uint end = min(points, (gl_WorkGroupID.x + 1) * kPointsPerGroup);
  for (uint i = gl_WorkGroupID.x * kPointsPerGroup + gl_LocalInvocationIndex; i < end; i += kThreads) {
    const uint word = first_word + i * kStride;
    const uvec3 bits = uvec3(words[word], words[word + 1], words[word + 2]);
    uint key = invalid_key;
    if (!any(greaterThanEqual(bits & 0x7fffffffu, uvec3(0x7f800000u)))) {
      const vec3 p = uintBitsToFloat(bits);
      key = interleaved(uvec3(cell(p.x, low_x, scale_x, bits_x), cell(p.y, low_y, scale_y, bits_y),
                              cell(p.z, low_z, scale_z, bits_z)));
    }
    keys[i] = key;
    numbers[i] = i;
  }
}
