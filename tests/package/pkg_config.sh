#!/usr/bin/env bash
# Builds examples with what pkg-config says of installed components, and runs them. Usage: pkg_config.sh EXAMPLES OUT
set -euo pipefail
examples=$1 out=$2
mkdir -p "$out"

build_and_run() { # EXAMPLE COMPONENT
  if ! pkg-config --exists "pcl_bv_$2"; then
    pkg-config --print-errors --exists "pcl_bv_$2" || true
    exit 1
  fi
  # shellcheck disable=SC2046
  ${CXX:-g++} -std=c++17 "$examples/$1.cpp" -o "$out/$1" $(pkg-config --cflags --libs "pcl_bv_$2")
  (cd "$out" && LD_LIBRARY_PATH=$(pkg-config --variable=libdir "pcl_bv_$2") "./$1" >/dev/null)
  echo "$1 by pcl_bv_$2.pc"
}

build_and_run 03_own_points core
build_and_run 08_bigger_than_memory io
build_and_run 07_regions nodes
