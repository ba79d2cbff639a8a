// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Readers of cloud files, and the writer of .pcd.
#pragma once

#include <filesystem>
#include <string>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the extension of a path in lower case with the dot, such as ".ply". Returns an empty string if the
/// path has no extension.
std::string lower_case_extension(const std::filesystem::path& path);

/// Returns whether the name ends in .pcd, .ply, .bin, .las or .laz, in upper or lower case. (In builds
/// without LASzip, .laz files cannot be read. The error of read_cloud() says why.)
bool is_cloud_name(const std::filesystem::path& path);

/// Options of read_cloud().
struct ReadOptions {
  /// Number of float32 values per point of .bin files, of which the first three are x, y, z. 0 means 4, or 5
  /// for names that end in .pcd.bin (nuScenes).
  std::size_t bin_fields = 0;
  /// Names of the columns of text files, separated by commas, each with an optional type: "x,y,z,label:u4,_".
  /// Types are i, u and f with the number of bytes; the default is f8. "_" is not used. If empty: the header
  /// of the file, or x, y, z and further columns.
  std::string columns{};
};

/// Reads a cloud. The extension selects the reader: read_ply() for .ply, read_bin() for .bin, read_las() for
/// .las and .laz, readers of NumPy's arrays for .npy and .npz, of plain text for .xyz, .txt, .csv, .asc and
/// .pts, and read_pcd() for all others. Text and .laz files are read by the threads of `execution`;
/// execution.isa is not used. Throws IoError with the reason. For extensions of other known formats (meshes,
/// recordings) the reason includes advice.
RawCloud read_cloud(const std::filesystem::path& path, const ReadOptions& options = {},
                    const Execution& execution = {Serial{}, Isa::scalar});

/// The content of a cloud file's header.
struct CloudHeader {
  RawCloud cloud;                           ///< The cloud without its points.
  ScalarType scalar = ScalarType::float32;  ///< Type of the coordinates in RawCloud::xyz().
  bool random_access = false;               ///< Whether each point can be read on its own (see CloudFile).
};

/// Reads the header of a cloud file. The points are not read. A later read can therefore still find that the
/// file is cut or damaged. Throws as read_cloud().
CloudHeader read_cloud_header(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a .pcd file in ascii, binary or binary_compressed encoding (also with blocks that were stored
/// without compression). The file must have fields x, y and z (or X, Y and Z) of float32, float64 or integer
/// types. The three types may differ (see RawCloud::xyz()). All other fields are read, too.
///
/// Sizes in the header are checked against the size of the file before anything is allocated. A file of 0
/// points gives an empty cloud.
///
/// Values in ascii files:
/// - Floating-point fields take the nearest value of their type. Numbers outside the range of the type become
///   infinity or zero.
/// - "nan" and "inf" in any case are accepted for floating-point fields only.
/// - Integer fields accept whole numbers in any notation (1.0, 1e3). Negative numbers in unsigned fields wrap
///   around, so -1 becomes the maximum.
/// - Any other text, such as an integer out of range, is an error in a coordinate. In another field the text
///   becomes 0 or NaN, and RawCloud::note reports it.
/// - Rows after the last point are an error.
///
/// Bytes after the last point of a binary file that could be further points are not read, and RawCloud::note
/// reports them. They are an error if the header says 0 points, because a recorder may have stopped before it
/// updated the header. RawCloud::note also reports a VIEWPOINT other than the identity. A viewpoint is never
/// applied. A field with COUNT 0 has no values: it is left out, and the note says so.
///
/// Ascii files are read by the threads of `execution`. The cloud and the error are the same for any number of
/// threads. In addition to the memory of the cloud, an ascii file needs 0.3 MiB per thread, or more if a row
/// is longer. A binary_compressed file needs the size of the points once more.
///
/// Throws IoError with the reason for a file that is missing, unreadable, empty, truncated, inconsistent or
/// of an unsupported type.
RawCloud read_pcd(const std::filesystem::path& path, const Execution& execution = {Serial{}, Isa::scalar});

/// Encodings of the points in a .pcd file, named as in the file's line DATA.
enum class PcdEncoding { ascii, binary, binary_compressed };

/// Writes all fields of the cloud, its width, height and viewpoint, through write_file_atomically(). The
/// values read back bit for bit, with two exceptions. The ascii encoding does not store the sign and payload
/// of a NaN. The binary_compressed encoding leaves out padding (fields named "_"), because PCL's reader does
/// not expect padding there.
///
/// Throws IoError if the file cannot be written, if an ascii cloud has a field of type F and size 1 or 2, or
/// if a binary_compressed cloud has more than 4e9 bytes of points. Throws std::invalid_argument for a cloud
/// that violates the rules of RawCloud or needs a header of more than 1 MiB.
void write_pcd(const std::filesystem::path& path, const RawCloud& cloud,
               PcdEncoding encoding = PcdEncoding::binary);

}  // namespace pcl_bv
