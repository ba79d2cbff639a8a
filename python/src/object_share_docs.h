// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Docstrings of the functions for shares of objects.
#pragma once

namespace pcl_bv::python {

inline constexpr const char* write_object_share_doc =
    R"(write_object_share(path, inputs, *, cluster, share=(0, 1), volumes=None, origin=None, memory=600, bin_fields=0, **settings)
--

Finds the objects of a share of a cloud in many files, and writes them to a file for merge_object_shares(), as
`pcd_bv --partial FILE --part K/N --cluster TOLERANCE` does, with the same bytes. Releases the GIL.

path: the file to be written, completely or not at all. Missing folders are created.
inputs: a path, or a list of paths: files, folders, recordings and 'synth:...', as for read() and frames(). All
    shares need the inputs of the whole cloud, in the same order. Or a cloud is processed independently of
    others, with inputs of its own.
cluster: the tolerance, in the points' unit, or a dict of settings: {'tolerance': 0.5, 'min_size': 30}.
share: (k, n): the share k of n, k from 0.
volumes: a method or a list of methods. None: ['obb-lshape'].
origin: three numbers that are subtracted from all coordinates. Ranges are still measured from where the coordinates
    were 0 or, if that is more than 500 m away, from the new origin.
memory: for points while they are clustered, megabytes.
bin_fields: as for read().
settings: other settings of Pipeline(), such as filter={'range_min': 1} and threads=0. Without them no point is
    dropped, and one thread is used. ground, track and a tolerance that grows with range are not available.

Raises ValueError for settings that are not allowed, FileNotFoundError, and OSError with the reason for an input
that cannot be read (then no file is written) and for a file that cannot be written.

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> parts = [os.path.join(folder.name, str(k)) for k in range(4)]
>>> for k, part in enumerate(parts):
...     pcl_bv.write_object_share(part, 'synth:street:20000:1', share=(k, 4), cluster=0.5)
>>> objects = pcl_bv.merge_object_shares(parts, cluster=0.5)
>>> objects[0].points >= objects[1].points >= 10
True
>>> folder.cleanup()
)";

inline constexpr const char* merge_object_shares_doc =
    R"(merge_object_shares(paths, *, cluster, volumes=None, memory=600, **settings)
--

Merges files of write_object_share() and of pcd_bv. Returns a list of Object: the objects of the whole cloud, the
largest first, as `pcd_bv --merge --cluster TOLERANCE` finds them, bit for bit. Releases the GIL.

paths: a path, or a list of paths: files, and folders of files, in any order. Files of inputs that were
    processed independently are one cloud, in the natural order of the names of their first inputs.
cluster: tolerance, min_points and classes as for the shares. Other values of min_size and max_size, and other
    volumes, are possible. Then the volumes are fitted again.
volumes, memory, settings: as for write_object_share(). Files of pcd_bv with --ground slope need the same ground:
    ground={'method': 'slope'}.

Raises ValueError for settings that are not allowed, FileNotFoundError, and OSError for files that are damaged,
that do not belong together, or of which some are missing. If only points of a file are damaged, warns
(UserWarning), and objects near these points are `incomplete`.

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> part = os.path.join(folder.name, 'part')
>>> pcl_bv.write_object_share(part, 'synth:street:20000:1', cluster={'tolerance': 0.5, 'min_size': 50})
>>> objects = pcl_bv.merge_object_shares(part, cluster={'tolerance': 0.5, 'min_size': 50}, volumes=['aabb'])
>>> objects[0].methods, objects[0]['aabb'].shape
(['aabb'], 'aabb')
>>> folder.cleanup()
)";

inline constexpr const char* object_doc = R"(Object
--

An object of merge_object_shares(), with its volumes. It can be pickled. `object[method]` is the volume of a
method.

>>> import os, pcl_bv, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> part = os.path.join(folder.name, 'part')
>>> pcl_bv.write_object_share(part, 'synth:street:20000:1', cluster=0.5, volumes='sphere')
>>> first = pcl_bv.merge_object_shares(part, cluster=0.5, volumes='sphere')[0]
>>> first.id, first['sphere'] == first.volumes[0]
(0, True)
>>> folder.cleanup()
)";

}  // namespace pcl_bv::python
