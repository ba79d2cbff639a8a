// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes as files: read back by our own reader, and looked at as text.

#include "pcl_bv/report/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <iterator>
#include <limits>

#include "files.h"
#include "pcl_bv/io/ply.h"
#include "volume_cells.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;
using testing::Not;

const Aabb box({-1, 0.1, 5e6 + 1.0 / 3}, {2, 3, 5e6 + 7});
const Sphere ball({7, 8, 9}, 0.1);

Kdop kdop_of(const std::vector<Eigen::Vector3d>& points) {
  Kdop kdop(KdopSet::dop14());
  for (const Eigen::Vector3d& point : points)
    kdop.extend(point);
  return kdop;
}

std::vector<ClusterEntry> one_cluster(std::vector<VolumeEntry> volumes) {
  return {{0, 10, std::move(volumes)}};
}

std::uint32_t colour_at(const RawCloud& cloud, std::size_t i) {
  std::uint32_t colour = 0;
  std::memcpy(&colour, &cloud.data.at(i * cloud.point_step + find_field(cloud, "red")->offset), 3);
  return colour;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

class Meshes : public FileTest {
 protected:
  RawCloud vertices_of(const std::vector<ClusterEntry>& clusters) const {
    write_text(file("a.ply"), volumes_ply(clusters));
    return read_ply(file("a.ply"));
  }
};

TEST_F(Meshes, PlyVerticesAreThoseOfTheMeshToTheBit) {
  const RawCloud cloud = vertices_of(one_cluster({{"aabb", box, {}}, {"sphere-exact", ball, {}}}));
  std::vector<Eigen::Vector3d> expected = box.mesh().vertices;
  for (const Eigen::Vector3d& vertex : ball.mesh().vertices)
    expected.push_back(vertex);
  ASSERT_EQ(cloud.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Coordinates p = load_point(cloud.xyz(), i);
    EXPECT_EQ(Eigen::Vector3d(p.x, p.y, p.z), expected[i]);
  }
}

TEST_F(Meshes, PlyFacesAreThoseOfTheMeshAndKnowTheirVolume) {
  const std::string ply =
      volumes_ply({{0, 1, {{"m", Aabb(), {}}, {"aabb", box, {}}}}, {5, 1, {{"aabb", box, {}}}}});
  EXPECT_THAT(ply, HasSubstr("comment method 0 is m\ncomment method 1 is aabb\n"));
  EXPECT_THAT(ply, HasSubstr("element vertex 16\n"));
  EXPECT_THAT(ply, HasSubstr("element face 12\n"));
  EXPECT_THAT(ply, Not(HasSubstr("element edge")));
  constexpr std::size_t face_bytes = 1 + 4 * 4 + 4 + 4;
  ASSERT_EQ(ply.size(), ply.find("end_header\n") + 11 + 16 * 27 + 12 * face_bytes);
  const char* face = ply.data() + ply.size() - face_bytes;
  EXPECT_EQ(face[0], 4);
  std::int32_t numbers[6];
  std::memcpy(numbers, face + 1, sizeof numbers);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(numbers[i], 8 + box.mesh().faces[5][static_cast<std::size_t>(i)]);
  EXPECT_EQ(numbers[4], 5);
  EXPECT_EQ(numbers[5], 1);
}

TEST_F(Meshes, PlyHasLinesAsEdgesAndPointsAsVertices) {
  const auto ply = volumes_ply(one_cluster({{"dop14", kdop_of({{0, 0, 0}, {4, 0, 0}}), {}}}));
  EXPECT_THAT(ply, HasSubstr("element vertex 2\n"));
  EXPECT_THAT(ply, HasSubstr("element face 0\n"));
  EXPECT_THAT(ply, HasSubstr("element edge "));
  const RawCloud point = vertices_of(one_cluster({{"dop14", kdop_of({{1, 2, 3}}), {}}}));
  ASSERT_EQ(point.size(), 1u);
  EXPECT_EQ(load_point(point.xyz(), 0).z, 3);
}

TEST_F(Meshes, PlyIsColouredByClusterOrByMethodIfThereIsOnlyOne) {
  const RawCloud clusters =
      vertices_of({{0, 1, {{"aabb", box, {}}, {"dop6", box, {}}}}, {1, 1, {{"aabb", box, {}}}}});
  EXPECT_EQ(colour_at(clusters, 0), colour_at(clusters, 8));
  EXPECT_NE(colour_at(clusters, 0), colour_at(clusters, 16));
  const RawCloud methods = vertices_of(one_cluster({{"aabb", box, {}}, {"dop6", box, {}}}));
  EXPECT_NE(colour_at(methods, 0), colour_at(methods, 8));
  EXPECT_EQ(colour_at(methods, 0), colour_at(clusters, 0));
}

TEST_F(Meshes, PlyHoldsFacesOfManyCorners) {
  for (const std::size_t corners : {255u, 256u, 300u}) {
    VolumeCells cells;
    cells.methods = {"hull"};
    cells.owners = {{7, 0, 300, 1}};
    cells.polygons = {{{}, 0}, {{0, 1, 2}, 0}};
    for (std::size_t i = 0; i < corners; ++i) {
      cells.vertices.emplace_back(static_cast<double>(i), 0, 0);
      cells.vertex_owners.push_back(0);
      cells.polygons[0].vertices.push_back(static_cast<std::int32_t>(i));
    }
    const std::string ply = cells_ply(cells, true);
    const std::size_t count_bytes = corners > 255 ? 4 : 1;
    EXPECT_THAT(ply, HasSubstr(count_bytes == 1 ? "list uchar int" : "list int int"));
    std::int32_t count = 0;
    const std::size_t body = ply.find("end_header\n") + 11 + corners * 27;
    std::memcpy(&count, ply.data() + body, count_bytes);
    EXPECT_EQ(count, static_cast<std::int32_t>(corners));
    EXPECT_EQ(ply.size(), body + 2 * (count_bytes + 8) + 4 * (corners + 3));
  }
}

TEST_F(Meshes, OfNothingAreFilesWithoutVertices) {
  const auto empty_volumes = one_cluster({{"aabb", Aabb(), {}}, {"sphere-exact", Sphere(), {}}});
  for (const auto& clusters : {std::vector<ClusterEntry>(), empty_volumes}) {
    EXPECT_EQ(vertices_of(clusters).size(), 0u);
    EXPECT_THAT(volumes_vtp(clusters), HasSubstr("<Piece NumberOfPoints=\"0\" NumberOfVerts=\"0\""));
  }
}

TEST_F(Meshes, VtpCountsWhatItHolds) {
  const std::string vtp = volumes_vtp(
      one_cluster({{"aabb", box, {}}, {"dop14", kdop_of({{1, 2, 3}}), {}}, {"sphere-exact", ball, {}}}));
  EXPECT_THAT(vtp, HasSubstr("<Piece NumberOfPoints=\"171\" NumberOfVerts=\"1\" NumberOfLines=\"0\" "
                             "NumberOfStrips=\"0\" NumberOfPolys=\"326\">"));
  EXPECT_EQ(count_of(vtp, "<DataArray "), count_of(vtp, "</DataArray>"));
  EXPECT_THAT(vtp, HasSubstr("\n-1 0.1 5000000.333333333\n"));  // shortest digits: no rounding, no padding
}

TEST_F(Meshes, VtpOfTrackedObjectsHasTheirAgeAndVelocity) {
  std::vector<ClusterEntry> clusters = one_cluster({{"aabb", box, {}}});
  clusters.push_back(clusters[0]);
  clusters[1].track = {7, 12, {1.5, -0.25, 0}};
  const std::string vtp = volumes_vtp(clusters, true);  // boxes have six faces
  EXPECT_THAT(vtp, HasSubstr("Name=\"track\" format=\"ascii\">\n-1 -1 -1 -1 -1 -1 7 7 7 7 7 7 \n"));
  EXPECT_THAT(vtp, HasSubstr("Name=\"age\" format=\"ascii\">\n0 0 0 0 0 0 12 12 12 12 12 12 \n"));
  EXPECT_THAT(vtp, HasSubstr("Name=\"velocity\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0 0 0 0 "));
  EXPECT_EQ(count_of(vtp, "1.5 -0.25 0 "), 6U);
  EXPECT_EQ(volumes_vtp(clusters).find("velocity"), std::string::npos);
}

TEST_F(Meshes, VolumesBeyondTheRangeOfDoubleAreAnError) {
  const auto clusters = one_cluster({{"aabb", Aabb({-1e200, -1e200, -1e200}, {1e200, 1e200, 1e200}), {}}});
  EXPECT_THROW(volumes_vtp(clusters), std::domain_error);
  EXPECT_EQ(vertices_of(clusters).size(), 8u);  // has no volumes in it
}

TEST_F(Meshes, AreWrittenWholeInTheFormatAsked) {
  const auto clusters = one_cluster({{"aabb", box, {}}});
  write_volumes(file("m"), clusters, MeshFormat::ply);
  EXPECT_EQ(file_content(file("m")), volumes_ply(clusters));
  write_volumes(file("m"), clusters, MeshFormat::vtp);
  EXPECT_EQ(file_content(file("m")), volumes_vtp(clusters));
  EXPECT_THROW(write_volumes(file("no/m"), clusters, MeshFormat::ply), IoError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), {}), 1);
}

TEST(MeshFormat, IsThatOfTheExtension) {
  EXPECT_EQ(mesh_format("a.ply"), MeshFormat::ply);
  EXPECT_EQ(mesh_format("x/a.b.VTP"), MeshFormat::vtp);
  for (const char* name : {"a", "a.obj", "ply", ".ply", "a.ply/b", ""})
    EXPECT_EQ(mesh_format(name), std::nullopt) << name;
}

TEST(Pvd, ListsTheFramesWithTheirTimes) {
  EXPECT_EQ(std::string(kPvdBegin) + pvd_entry({0, "a_0.vtp"}) + pvd_entry({0.1, "b & \"c\" <d>.vtp", 1}) +
                pvd_entry({1e-9, "\xc3\xa4.vtp"}) + std::string(kPvdEnd),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0\" part=\"0\" file=\"a_0.vtp\"/>\n"
            "    <DataSet timestep=\"0.1\" part=\"1\" file=\"b &amp; &quot;c&quot; &lt;d>.vtp\"/>\n"
            "    <DataSet timestep=\"1e-09\" part=\"0\" file=\"\xc3\xa4.vtp\"/>\n"
            "  </Collection>\n</VTKFile>\n");
}

TEST(Pvd, RefusesWhatXmlCannotHold) {
  EXPECT_THROW(pvd_entry({0, "a\nb.vtp"}), std::invalid_argument);
  EXPECT_THROW(pvd_entry({std::numeric_limits<double>::infinity(), "a.vtp"}), std::domain_error);
}

}  // namespace
}  // namespace pcl_bv::detail
