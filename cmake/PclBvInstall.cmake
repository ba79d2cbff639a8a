include(CMakePackageConfigHelpers)
set(libraries ${PCL_BV_COMPONENTS})
list(REMOVE_ITEM libraries dds draco live ros1 mpi python) # modules, a node and a command, which nobody links
list(REMOVE_ITEM libraries segmentation laz)          # parts of core and io
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_bv)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/pcl_bvConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/pcl_bvConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pcl_bvConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pcl_bvConfig.cmake ${PROJECT_BINARY_DIR}/pcl_bvConfigVersion.cmake
        DESTINATION ${package_dir})
foreach(component ${libraries})
  install(EXPORT pcl_bv_${component} FILE pcl_bv_${component}.cmake NAMESPACE pcl_bv:: DESTINATION ${package_dir})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/pcl_bv)
include(PclBvPkgConfig)
