// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Our meshes as VTK, which ParaView is made of, and PCL read them.
#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/console/print.h>
#include <pcl/io/ply_io.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "files.h"
#include "pcl_bv/report/meshes.h"

namespace pcl_bv::detail {
namespace {

const Aabb box({-1, 0.1, 5e6 + 1.0 / 3}, {2, 3, 5e6 + 7});

std::vector<ClusterEntry> sample() {
  Kdop point(KdopSet::dop14()), line(KdopSet::dop14());
  point.extend({1e-41, 2, -3});
  line.extend({0, 0, 0}).extend({4, 0, 0});
  return {{0, 700, {{"aabb", box, {}}, {"dop14", point, {}}, {"sphere-exact", Sphere({7, 8, 9}, 0.1), {}}}},
          {1, 20, {{"aabb", Aabb(), {}}, {"dop14", line, {}}, {"sphere-exact", Sphere(), {}}}}};
}

class MeshesAgainstVtk : public FileTest {
 protected:
  MeshesAgainstVtk() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }

  vtkSmartPointer<vtkPolyData> read_vtp(const std::vector<ClusterEntry>& clusters) const {
    write_volumes(file("a.vtp"), clusters, MeshFormat::vtp);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file("a.vtp").c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0u);
    return reader->GetOutput();
  }
};

TEST_F(MeshesAgainstVtk, EveryCellOfAVtpIsThereWithItsData) {
  const auto data = read_vtp(sample());
  EXPECT_EQ(data->GetNumberOfVerts(), 1);
  EXPECT_EQ(data->GetNumberOfLines(), mesh(sample()[1].volumes[1].volume).faces.size());
  EXPECT_GE(data->GetNumberOfLines(), 1);
  EXPECT_EQ(data->GetNumberOfPolys(), 6 + 320);
  const auto value = [&](const char* name, vtkIdType cell) {
    return data->GetCellData()->GetArray(name)->GetTuple1(cell);
  };
  ASSERT_EQ(data->GetCellData()->GetArray("volume")->GetNumberOfTuples(), data->GetNumberOfCells());
  EXPECT_EQ(value("cluster", 0), 0);  // the vertex: cells count vertices, lines, polygons
  EXPECT_EQ(value("method", 0), 1);
  EXPECT_EQ(value("cluster", 1), 1);  // the line
  EXPECT_EQ(value("points", 1), 20);
  const vtkIdType first_polygon = 1 + data->GetNumberOfLines();
  EXPECT_EQ(value("method", first_polygon), 0);
  EXPECT_EQ(value("volume", first_polygon), box.volume());
  EXPECT_EQ(value("method", first_polygon + 6), 2);
  EXPECT_EQ(value("points", first_polygon + 6), 700);
}

TEST_F(MeshesAgainstVtk, CoordinatesOfAVtpAreReadToTheBit) {
  const auto data = read_vtp({sample()[0]});
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(Eigen::Vector3d(data->GetPoint(i)), box.corners()[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(Eigen::Vector3d(data->GetPoint(8)), Eigen::Vector3d(1e-41, 2, -3));
}

TEST_F(MeshesAgainstVtk, NamesOfTheMethodsAreInTheFieldData) {
  const auto data = read_vtp(sample());
  const auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("methods"));
  ASSERT_NE(names, nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), 3);
  EXPECT_EQ(const_cast<vtkStringArray*>(names)->GetValue(0), "aabb");
  EXPECT_EQ(const_cast<vtkStringArray*>(names)->GetValue(2), "sphere-exact");
}

TEST_F(MeshesAgainstVtk, AVtpOfNothingIsAnEmptyMesh) {
  EXPECT_EQ(read_vtp({})->GetNumberOfCells(), 0);
  EXPECT_EQ(read_vtp({{0, 0, {{"aabb", Aabb(), {}}}}})->GetNumberOfPoints(), 0);
}

TEST_F(MeshesAgainstVtk, VtkReadsThePlyWithItsColours) {
  write_volumes(file("a.ply"), sample(), MeshFormat::ply);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file("a.ply").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPolys(), 6 + 320);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 8 + 1 + 162 + 2);
}

TEST_F(MeshesAgainstVtk, PclReadsThePly) {
  write_volumes(file("a.ply"), {{0, 8, {{"aabb", Aabb({0, 1, 2}, {3, 4, 5}), {}}}}}, MeshFormat::ply);
  pcl::PolygonMesh mesh;
  ASSERT_EQ(pcl::PLYReader().read(file("a.ply").string(), mesh), 0);
  EXPECT_EQ(mesh.cloud.width, 8u);
  ASSERT_EQ(mesh.polygons.size(), 6u);
  EXPECT_EQ(mesh.polygons[0].vertices.size(), 4u);
}

}  // namespace
}  // namespace pcl_bv::detail
