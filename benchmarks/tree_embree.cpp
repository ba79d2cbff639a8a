// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points as Embree's spheres.

#include <embree3/rtcore.h>

#include <limits>
#include <stdexcept>

#include "tree_peers.h"

namespace pcl_bv::bench {
namespace {

class Spheres : public Rays {
 public:
  Spheres(const TreeCloud& cloud, float radius)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), cloud.size()));
    if (to == nullptr) throw std::runtime_error("Embree has no memory or no spheres");
    for (const pcl::PointXYZ& p : cloud) {
      *to++ = p.x, *to++ = p.y, *to++ = p.z;
      *to++ = radius;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }

  Spheres(const Spheres&) = delete;
  Spheres& operator=(const Spheres&) = delete;

  ~Spheres() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  double first_hit(const float (&origin)[3], const float (&direction)[3]) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray = {};
    ray.ray.org_x = origin[0], ray.ray.org_y = origin[1], ray.ray.org_z = origin[2];
    ray.ray.dir_x = direction[0], ray.ray.dir_y = direction[1], ray.ray.dir_z = direction[2];
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity()
                                                     : double{ray.ray.tfar};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace

std::unique_ptr<Rays> embree_spheres(const TreeCloud& cloud, float radius) {
  return std::make_unique<Spheres>(cloud, radius);
}

}  // namespace pcl_bv::bench
