// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Reads all volumes of a JSON file written by pcd_bv, bv_stream or by hand. The file has one JSON value or
/// several, such as one per line. A volume is an object, nested at most 64 deep, with a member "shape" and
/// the numbers of the shape as in report_json(). The result is equal to the written volumes bit for bit.
/// Volumes with "empty": true are left out.
///
/// The file may also have boxes in a format of box_labels.h: KITTI's labels, OpenLABEL, results or
/// annotations of nuScenes, or labels of SUSTechPOINTS. They become oriented boxes with the exact centres and
/// sizes of the file, except that the centre of a KITTI label is half its height above its location, which is
/// rounded. Boxes of the type DontCare are left out. Cuboids of OpenLABEL with several values of
/// "coordinate_system" are an error.
///
/// A value that may be meant as a volume must be a volume or contain one, at any depth. Such values are:
/// - each entry of a list or object "volumes", and a value "volumes" that is neither list nor object;
/// - each entry of a list that has a volume as an entry;
/// - each object next to a volume in the same object;
/// - each JSON value of the file, if one of them is itself a volume.
///
/// Throws IoError, which names the entry ("clusters[0].volumes[2]"), if
/// - such a value has no volume;
/// - the "shape" is unknown, or a number of the shape is missing or of the wrong type;
/// - a volume has "failed" (its fit failed);
/// - a volume is empty, but does not have "empty": true.
///
/// Also throws IoError if the file cannot be read, has more than 1 GiB, is not valid JSON, or has no volumes
/// other than empty ones.
std::vector<AnyVolume> read_volumes(const std::filesystem::path& file);

}  // namespace detail
}  // namespace pcl_bv
