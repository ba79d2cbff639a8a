// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Docstrings of the functions and classes for reading.
#pragma once

namespace pcl_bv::python {

inline constexpr const char* read_doc = R"(read(path, *, topic=None, number=0, bin_fields=0, threads=1)
--

Reads a cloud: an array of records with all fields of the file, (height, width) of organised ones.

path: .pcd, .ply, .las, .bin (KITTI, nuScenes), or 'synth:NAME[:POINTS[:SEED]]'; of a recording (.mcap, .db3,
    .bag, .pcap) the cloud of this number. Recordings are quicker read by frames().
topic: of a recording; None: the only one with clouds.
bin_fields: float32 of each point of a .bin, 3 to 32; 0: what the name says, 5 of .pcd.bin, else 4.

What was noticed and not refused, such as points after the last one, a VIEWPOINT, which is not applied, or
damage in a recording, is a UserWarning.
Raises FileNotFoundError, OSError for what cannot be read, ValueError for a topic that is not there.

>>> import pcl_bv
>>> cloud = pcl_bv.read('synth:street:1000:1')
>>> cloud.shape, cloud.dtype.names[:3]
((64, 16), ('x', 'y', 'z'))
)";

inline constexpr const char* frames_doc =
    R"(frames(source, *, topic=None, rate=None, poses=None, class_field=None, frame_id=None, stamps='auto', bin_fields=0)
--

The frames of a source, one after another, as what Pipeline.process() takes: an iterator over Frame.

source: a folder of clouds or a file, a recording (.mcap, .db3 or its folder, .bag, .pcap), 'dds:TOPIC', or
    'synth:street-sequence[:FRAMES[:SEED]]'.
rate: in Hz; None: of recordings their own stamps, else 10. No frame waits for its time.
poses: a file of the sensor's poses, KITTI's or TUM's.
class_field: an integer field of the clouds, for Frame.classes.
stamps: 'rate', 'name' (of files' names, or of messages) or 'auto'.

What was noticed about a file and not refused is a UserWarning, as of read().

Raises FileNotFoundError, OSError for what cannot be read, also of one frame: the next may be fine.

>>> import pcl_bv
>>> pipeline = pcl_bv.Pipeline(track={'enabled': True})
>>> for frame in pcl_bv.frames('synth:street-sequence:3'):
...     result = pipeline.process(frame.points, stamp_ns=frame.stamp_ns)
>>> result.clusters[0].track.age
3
)";

inline constexpr const char* frame_doc =
    R"(A cloud of a source, with its stamp; points are in its own memory, which lives as long as arrays of it.

>>> import pcl_bv
>>> next(pcl_bv.frames('synth:street-sequence:1')).points.shape[1]
3
)";

inline constexpr const char* frames_class_doc =
    R"(What frames() gives: an iterator. Threads may share it: each frame goes to one of them.

>>> import pcl_bv
>>> len(list(pcl_bv.frames('synth:street-sequence:2')))
2
)";

inline constexpr const char* read_volumes_doc = R"(read_volumes(path)
--

All volumes of a JSON file that pcd_bv, bv_stream or write() made, or of one by hand, bit by bit as they were.

Volumes with "empty": true are left out. Raises FileNotFoundError; OSError for a file that is no such file, naming the
first entry that cannot be read ('clusters[0].volumes[2]').

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> path = os.path.join(folder.name, 'ball.json')
>>> pcl_bv.write(path, pcl_bv.Sphere([1, 2, 3], 0.1))
>>> pcl_bv.read_volumes(path) == [pcl_bv.Sphere([1, 2, 3], 0.1)]
True
>>> folder.cleanup()
)";

}  // namespace pcl_bv::python
