// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the candidates for the results of queries, one thread per query. A query minimises a value over the
// points of a tree: the squared distance from a position, or the distance that a moving sphere travels until
// it touches the point. Floats give an interval for the value of each point. The points whose intervals begin
// at or below the smallest end of an interval are the candidates. docs/numerics.md proves the intervals.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "boxes.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kKind = 0;  // kAny, kNearest or kFirstHit

layout(std430, binding = 0) readonly buffer Packets { uint packets[]; };
layout(std430, binding = 1) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 2) readonly buffer Boxes { float boxes[]; };
struct Query {
  vec3 position;   // relative to the centre; of a moving sphere, its origin
  float limit;     // points with larger values are no result
  vec3 direction;  // of the moving sphere, a unit vector
  float error;     // part of the error of distances that does not depend on the point
  float inside;    // kAny: points with at most this value are inside without doubt
  float radius;    // of the moving sphere
  float unused_1, unused_2;
};
layout(std430, binding = 3) readonly buffer Queries { Query queries[]; };
struct Candidate {
  uint x, y, z, number;
};
struct Result {
  uint candidates;  // number of them, kMany or kCertainly
  uint unused_1, unused_2, unused_3;
  Candidate found[4];
};
layout(std430, binding = 4) writeonly buffer Results { Result results[]; };
layout(push_constant) uniform Tree {
  float center_x, center_y, center_z;
  uint count;     // of queries
  uint levels;    // of boxes
  uint first[6];  // number of the first group of each level
};

const uint kAny = 0, kNearest = 1, kFirstHit = 2;
const uint kMaxLevels = 6;
const uint kMaxCandidates = 4;
// A query that takes more steps is left to the processor. Cards can be reset while a shader runs for seconds,
// and Mesa's software driver leaves a loop silently after 65 535 iterations of all loops together.
const uint kMaxSteps = 1024;
const uint kMany = 0xfffffffeu;        // more than kMaxCandidates
const uint kCertainly = 0xffffffffu;   // a point is inside without doubt
const float kNever = 3e38;             // value of points that are no result
const float kUp = 1.0000152587890625;  // 1 + 2^-16
const float kDown = 0.9999847412109375;
const float kErrorPerCoordinate = 3.814697265625e-6;  // 2^-18

Query query;
float limit;  // the smallest end of an interval so far
uint found;
float found_values[kMaxCandidates];
uint found_slots[kMaxCandidates];  // packet * kWidth + lane
uint dropped;                      // candidates for which the list had no space
uint steps;                        // of walk()
float smallest_dropped;            // beginning of an interval

struct Interval {
  float low, high;
};

float squared(vec3 v) {
  precise const float sum = v.x * v.x + v.y * v.y + v.z * v.z;
  return sum;
}

// Returns the error of distances of a point. `magnitude` is its largest coordinate.
float error_for(float magnitude) {
  precise const float error = query.error + magnitude * kErrorPerCoordinate;
  return error;
}

float magnitude_of(vec3 v) {
  return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

Interval squared_distance(float square, float error) {
  precise const float distance = sqrt(square);
  precise const float low = max(distance * kDown - error, 0.0), high = distance * kUp + error;
  precise const float low_square = low * low * kDown, high_square = high * high * kUp;
  return Interval(low_square, high_square);
}

// A point relative to the line of the moving sphere.
struct LinePosition {
  float along;     // signed distance from the origin to the nearest point of the line
  float distance;  // from the line
};

LinePosition line_position(vec3 point) {
  precise const vec3 p = point - query.position;
  precise const float along = dot(p, query.direction);
  precise const vec3 offset = p - along * query.direction;
  return LinePosition(along, sqrt(squared(offset)));
}

// Returns half of the length of the part of the line that is inside a sphere.
float half_chord(float radius, float distance) {
  precise const float product = (radius - distance) * (radius + distance);
  return sqrt(max(product, 0.0));
}

Interval hit_distance(vec3 point) {
  const LinePosition at = line_position(point);
  const float error = error_for(magnitude_of(point));
  precise const float outer = query.radius * kUp + 2 * error, inner = query.radius * kDown - 2 * error;
  if (at.distance > outer) return Interval(kNever, kNever);
  precise const float max_half = half_chord(outer, at.distance) * kUp + error;
  precise const float exit = at.along + max_half, low = at.along - max_half;
  if (exit < 0) return Interval(kNever, kNever);
  Interval interval = Interval(max(low, 0.0), kNever);
  if (at.distance < inner) {
    precise const float min_half = half_chord(inner, at.distance) * kDown - error;
    precise const float sure_exit = at.along + min_half, high = at.along - min_half;
    if (sure_exit > 0) interval.high = max(high, 0.0);
  }
  return interval;
}

Interval value_of_point(vec3 point) {
  if (kKind == kFirstHit) return hit_distance(point);
  precise const vec3 p = point - query.position;
  return squared_distance(squared(p), error_for(magnitude_of(point)));
}

// Returns a lower bound of the values of the points in a box.
float value_of_box(uint group, uint box) {
  const vec3 low =
      vec3(boxes[box_word(group, 0, box)], boxes[box_word(group, 1, box)], boxes[box_word(group, 2, box)]);
  const vec3 high =
      vec3(boxes[box_word(group, 3, box)], boxes[box_word(group, 4, box)], boxes[box_word(group, 5, box)]);
  if (low.x > high.x) return kNever;
  const float error = error_for(max(magnitude_of(low), magnitude_of(high)));
  if (kKind != kFirstHit) {
    precise const vec3 outside = max(max(low - query.position, query.position - high), vec3(0));
    return squared_distance(squared(outside), error).low;
  }
  // The ball around the box.
  const LinePosition at = line_position(0.5 * low + 0.5 * high);
  precise const float radius = 0.5 * sqrt(squared(high - low)) + query.radius;
  precise const float outer = radius * kUp + 4 * error;
  precise const float nearest = at.along - outer, farthest = at.along + outer;
  return at.distance > outer || farthest < 0 ? kNever : max(nearest, 0.0);
}

// Stores the candidates with the smallest values.
void add_candidate(float value, uint slot) {
  if (found < kMaxCandidates) {
    found_values[found] = value;
    found_slots[found++] = slot;
    return;
  }
  uint largest = 0;
  for (uint i = 1; i < kMaxCandidates; ++i)
    largest = found_values[i] > found_values[largest] ? i : largest;
  ++dropped;
  smallest_dropped = min(smallest_dropped, max(found_values[largest], value));
  if (value >= found_values[largest]) return;
  found_values[largest] = value;
  found_slots[largest] = slot;
}

uint word_of(uint slot) {
  return slot / kWidth * (3 * kWidth) + slot % kWidth;
}

vec3 point_at(uint slot) {
  const uint word = word_of(slot);
  precise const vec3 p = vec3(uintBitsToFloat(packets[word]), uintBitsToFloat(packets[word + kWidth]),
                              uintBitsToFloat(packets[word + 2 * kWidth])) -
                         vec3(center_x, center_y, center_z);
  return p;
}

// Returns whether a point of the packet is inside without doubt.
bool visit(uint packet) {
  for (uint slot = packet * kWidth; slot < (packet + 1) * kWidth; ++slot) {
    if (numbers[slot] == kNone) continue;
    const Interval value = value_of_point(point_at(slot));
    if (value.low > limit) continue;
    if (kKind == kAny && value.high <= query.inside) return true;
    if (kKind != kAny) limit = min(limit, value.high);
    add_candidate(value.low, slot);
  }
  return false;
}

uint groups[kMaxLevels];                // on each level, the group whose boxes are visited
float box_values[kMaxLevels * kWidth];  // of its boxes; kNever for those that were visited

void enter(uint level, uint group) {
  groups[level] = group;
  for (uint box = 0; box < kWidth; ++box)
    box_values[level * kWidth + box] = value_of_box(first[level] + group, box);
}

// Returns the box of a level that was not visited yet and has the smallest value; kWidth if none can have a
// candidate.
uint next_box(uint level) {
  float smallest = kNever;
  uint next = kWidth;
  for (uint box = 0; box < kWidth; ++box) {
    const float value = box_values[level * kWidth + box];
    if (value >= smallest) continue;
    smallest = value;
    next = box;
  }
  return smallest <= limit ? next : kWidth;
}

// Whether the processor has to run the query.
bool gives_up() {
  return steps > kMaxSteps || (kKind == kAny && dropped > 0);
}

// Visits the packets depth-first, in each group the box with the smallest value first. Returns whether a
// point is inside without doubt.
bool walk() {
  uint level = levels - 1;
  enter(level, 0);
  while (!gives_up()) {
    ++steps;
    const uint next = next_box(level);
    if (next == kWidth) {
      if (++level == levels) return false;
      continue;
    }
    box_values[level * kWidth + next] = kNever;
    const uint child = groups[level] * kWidth + next;
    if (level == 0) {
      if (visit(child)) return true;
    } else {
      enter(--level, child);
    }
  }
  return false;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  query = queries[i];
  limit = query.limit;
  found = 0;
  dropped = 0;
  steps = 0;
  smallest_dropped = kNever;
  if (walk()) {
    results[i].candidates = kCertainly;
    return;
  }
  if (gives_up() || smallest_dropped <= limit) {
    results[i].candidates = kMany;
    return;
  }
  uint written = 0;
  for (uint c = 0; c < found; ++c) {
    if (found_values[c] > limit) continue;
    const uint word = word_of(found_slots[c]);
    results[i].found[written++] = Candidate(packets[word], packets[word + kWidth], packets[word + 2 * kWidth],
                                            numbers[found_slots[c]]);
  }
  results[i].candidates = written;
}
