// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Answers questions about the points of a tree, one thread per question. For each point there is a lower
// bound of what is asked for (a squared distance, or the way until a moving sphere touches it), and mostly an
// upper bound. The points whose lower bound is at most the smallest upper bound are the candidates, among
// which the processor finds the answer. docs/numerics.md proves that the answer is among them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "boxes.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kQuestion = 0;  // kAny, kNearest or kFirstHit

layout(std430, binding = 0) readonly buffer Packets { uint packets[]; };
layout(std430, binding = 1) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 2) readonly buffer Boxes { float boxes[]; };
struct Question {
  vec3 place;      // the point or the origin of the moving sphere, relative to the centre
  float limit;     // points with a larger lower bound are no answer
  vec3 direction;  // of the moving sphere, a unit vector
  float error;     // bound of the errors of a distance
  float inside;    // kAny: points with at most this squared distance are certainly inside.
                   // kFirstHit: points within this distance of the line are certainly touched.
  float reach;     // kFirstHit: points farther from the line are certainly not touched
  float unused_1, unused_2;
};
layout(std430, binding = 3) readonly buffer Questions { Question questions[]; };
struct Candidate {
  uint x, y, z, number;
};
struct Answer {
  uint candidates;  // number of them, kMany or kCertainly
  uint unused_1, unused_2, unused_3;
  Candidate found[4];
};
layout(std430, binding = 4) writeonly buffer Answers { Answer answers[]; };
layout(push_constant) uniform Tree {
  float center_x, center_y, center_z;
  uint count;     // of questions
  uint levels;    // of boxes
  uint first[6];  // number of the first group of each level
};

const uint kAny = 0, kNearest = 1, kFirstHit = 2;
const uint kMostLevels = 6;
const uint kMost = 4;                  // candidates
const uint kMany = 0xfffffffeu;        // more candidates than kMost
const uint kCertainly = 0xffffffffu;   // a point is certainly inside
const float kNever = 3e38;
const float kUp = 1.0000152587890625;  // 1 + 2^-16
const float kDown = 0.9999847412109375;

Question question;
float limit;  // the smallest upper bound so far
uint found;
float found_bounds[kMost];
uint found_places[kMost];     // packet * kWidth + lane
float smallest_forgotten;     // lower bound of the candidates for which there was no room

struct Bounds {
  float lower, upper;
};

float squared(vec3 v) {
  precise const float sum = v.x * v.x + v.y * v.y + v.z * v.z;
  return sum;
}

// Where a point is relative to the line of the moving sphere: its distance from the line, and the way to the
// point of the line that is nearest to it.
struct Along {
  float way, distance;
};

Along along(vec3 point) {
  precise const vec3 p = point - question.place;
  precise const float way = dot(p, question.direction);
  precise const vec3 across = p - way * question.direction;
  return Along(way, sqrt(squared(across)));
}

Bounds hit_bounds(vec3 point) {
  const Along at = along(point);
  if (at.distance > question.reach) return Bounds(kNever, kNever);
  const float most = sqrt((question.reach - at.distance) * (question.reach + at.distance)) * kUp;
  if (at.way + most + question.error < 0) return Bounds(kNever, kNever);
  Bounds bounds = Bounds(max(at.way - most - question.error, 0.0), kNever);
  if (at.distance < question.inside) {
    const float least = sqrt((question.inside - at.distance) * (question.inside + at.distance)) * kDown;
    if (at.way + least - question.error > 0) bounds.upper = max(at.way - least + question.error, 0.0);
  }
  return bounds;
}

Bounds point_bounds(vec3 point) {
  if (kQuestion == kFirstHit) return hit_bounds(point);
  precise const vec3 p = point - question.place;
  const float square = squared(p);
  if (kQuestion == kAny) return Bounds(square, kNever);
  const float distance = sqrt(square) * kUp + question.error;
  return Bounds(square, distance * distance * kUp);
}

// Returns a lower bound for the points of a box.
float box_bound(uint group, uint box) {
  const vec3 low =
      vec3(boxes[box_word(group, 0, box)], boxes[box_word(group, 1, box)], boxes[box_word(group, 2, box)]);
  const vec3 high =
      vec3(boxes[box_word(group, 3, box)], boxes[box_word(group, 4, box)], boxes[box_word(group, 5, box)]);
  if (low.x > high.x) return kNever;
  if (kQuestion != kFirstHit) {
    precise const vec3 outside = max(max(low - question.place, question.place - high), vec3(0));
    return squared(outside);
  }
  // The ball around the box.
  const float radius = 0.5 * sqrt(squared(high - low)) * kUp;
  const Along at = along(0.5 * low + 0.5 * high);
  const float reach = question.reach + radius + question.error;
  if (at.distance > reach || at.way + reach + question.error < 0) return kNever;
  return max(at.way - reach - question.error, 0.0);
}

// Keeps the candidates with the smallest lower bounds.
void keep(float lower, uint place) {
  uint slot = found;
  if (found == kMost) {
    slot = 0;
    for (uint i = 1; i < kMost; ++i)
      slot = found_bounds[i] > found_bounds[slot] ? i : slot;
    smallest_forgotten = min(smallest_forgotten, max(found_bounds[slot], lower));
    if (lower >= found_bounds[slot]) return;
  } else {
    ++found;
  }
  found_bounds[slot] = lower;
  found_places[slot] = place;
}

vec3 point_at(uint place) {
  const uint word = place / kWidth * (3 * kWidth) + place % kWidth;
  precise const vec3 p = vec3(uintBitsToFloat(packets[word]), uintBitsToFloat(packets[word + kWidth]),
                              uintBitsToFloat(packets[word + 2 * kWidth])) -
                         vec3(center_x, center_y, center_z);
  return p;
}

// Returns whether the question is answered.
bool visit(uint packet) {
  for (uint place = packet * kWidth; place < (packet + 1) * kWidth; ++place) {
    if (numbers[place] == kNone) continue;
    const Bounds bounds = point_bounds(point_at(place));
    if (bounds.lower > limit) continue;
    if (kQuestion == kAny && bounds.lower <= question.inside) return true;
    limit = min(limit, bounds.upper);
    keep(bounds.lower, place);
  }
  return false;
}

uint groups[kMostLevels];            // on each level, the group whose boxes are visited
float bounds[kMostLevels * kWidth];      // of its boxes; kNever for those that were visited

void enter(uint level, uint group) {
  groups[level] = group;
  for (uint box = 0; box < kWidth; ++box)
    bounds[level * kWidth + box] = box_bound(first[level] + group, box);
}

// Returns the box of a level that was not visited yet and has the smallest bound; kWidth if none can have a
// candidate.
uint next_box(uint level) {
  float smallest = kNever;
  uint next = kWidth;
  for (uint box = 0; box < kWidth; ++box) {
    const float bound = bounds[level * kWidth + box];
    if (bound >= smallest) continue;
    smallest = bound;
    next = box;
  }
  return smallest <= limit ? next : kWidth;
}

// Visits the packets depth-first, in each group the box with the smallest bound first. Returns whether the
// question was answered on the way.
bool walk() {
  uint level = levels - 1;
  enter(level, 0);
  while (true) {
    const uint next = next_box(level);
    if (next == kWidth) {
      if (++level == levels) return false;
      continue;
    }
    bounds[level * kWidth + next] = kNever;
    const uint child = groups[level] * kWidth + next;
    if (level == 0) {
      if (visit(child)) return true;
    } else {
      enter(--level, child);
    }
  }
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  question = questions[i];
  limit = question.limit;
  found = 0;
  smallest_forgotten = kNever;
  if (walk()) {
    answers[i].candidates = kCertainly;
    return;
  }
  if (smallest_forgotten <= limit) {
    answers[i].candidates = kMany;
    return;
  }
  uint kept = 0;
  for (uint c = 0; c < found; ++c) {
    if (found_bounds[c] > limit) continue;
    const uint place = found_places[c], word = place / kWidth * (3 * kWidth) + place % kWidth;
    answers[i].found[kept++] =
        Candidate(packets[word], packets[word + kWidth], packets[word + 2 * kWidth], numbers[place]);
  }
  answers[i].candidates = kept;
}
