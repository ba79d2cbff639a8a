# An overlay port of the archive that it lies in: vcpkg install pcl-bv --overlay-ports=packaging/vcpkg
# Only core and the headers for PCL: liblzf, which io needs, has another name in vcpkg.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
                      OPTIONS "-DPCL_BV_COMPONENTS=core;pcl" -DPCL_BV_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME pcl_bv CONFIG_PATH lib/cmake/pcl_bv)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
