// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Docstrings of the functions and classes for reading.
#pragma once

namespace pcl_bv::python {
using namespace detail;

inline constexpr const char* read_doc = R"(read(path, *, topic=None, number=0, bin_fields=0, threads=1)
--

Reads a cloud. Returns an array of records with all fields of the file. For an organised cloud, the shape is
(height, width).

path: .pcd, .ply, .las, .laz, .bin (KITTI, nuScenes), NumPy's .npy and .npz, text (.xyz, .csv, .txt, .asc, .pts),
    'synth:NAME[:POINTS[:SEED]]', or a recording (.mcap, .db3, .bag, .pcap, .pcapng), of which cloud `number` is
    read. frames() reads a whole recording faster.
topic: the topic of a recording; None: the only topic with clouds.
bin_fields: number of float32 per point of a .bin file, 3 to 32. 0: chosen by the file name, 5 for .pcd.bin,
    otherwise 4.

Issues a UserWarning for data that is ignored or damaged: surplus data after the last point, a VIEWPOINT (not
applied), damage in a recording. Raises FileNotFoundError, OSError for a file that cannot be read, and
ValueError for a topic that the recording does not have.

>>> import pcl_bv
>>> cloud = pcl_bv.read('synth:street:1000:1')
>>> cloud.shape, cloud.dtype.names[:3]
((64, 16), ('x', 'y', 'z'))
)";

inline constexpr const char* frames_doc =
    R"(frames(source, *, topic=None, rate=None, poses=None, class_field=None, frame_id=None, stamps='auto', bin_fields=0)
--

Returns an iterator over the Frames of a source, for Pipeline.process().

source: a folder of clouds, a file as for read(), a recording (.mcap, .db3 or its folder, .bag, .pcap, .pcapng),
    'dds:TOPIC', or 'synth:street-sequence[:FRAMES[:SEED]]'.
rate: frame rate in Hz. None: the stamps of a recording, or 10 Hz for other sources. The iterator does not
    wait to keep this rate.
poses: a file of the sensor's poses, in KITTI's or TUM's format. If files of a folder are missing, the
    numbers in the file names select KITTI's lines.
class_field: an integer field of the clouds, for Frame.classes.
stamps: 'rate', 'name' (times in file names, or stamps of messages) or 'auto'.

Issues UserWarnings as read() does.

Raises FileNotFoundError, and OSError for a source or a frame that cannot be read. After an OSError for a
frame, the next frame may be valid.

>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(track={'enabled': True})
>>> for frame in pcl_bv.frames('synth:street-sequence:3'):
...     result = pipeline.process(frame.points, stamp_ns=frame.stamp_ns)
>>> result.clusters[0].track.age
3
)";

inline constexpr const char* frame_doc =
    R"(A cloud of a source, with its stamp. The points stay valid as long as an array of them exists.

>>> import pcl_bv
>>> next(pcl_bv.frames('synth:street-sequence:1')).points.shape[1]
3
)";

inline constexpr const char* frames_class_doc =
    R"(The iterator that frames() returns. Threads may share it. Each frame is given to one thread.

>>> import pcl_bv
>>> len(list(pcl_bv.frames('synth:street-sequence:2')))
2
)";

inline constexpr const char* read_volumes_doc = R"(read_volumes(path)
--

Reads all volumes of a JSON file written by pcd_bv, bv_stream, write() or by hand. Every number is restored
exactly.

Also reads boxes of other programs as Obb: labels of KITTI, OpenLABEL, nuScenes and SUSTechPOINTS
(docs/formats.md).

Volumes with "empty": true are skipped. Raises FileNotFoundError, and OSError for a file with other content.
The message of the OSError gives the first entry that cannot be read ('clusters[0].volumes[2]').

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> path = os.path.join(folder.name, 'ball.json')
>>> pcl_bv.write(path, pcl_bv.Sphere([1, 2, 3], 0.1))
>>> pcl_bv.read_volumes(path) == [pcl_bv.Sphere([1, 2, 3], 0.1)]
True
>>> folder.cleanup()
)";

}  // namespace pcl_bv::python
