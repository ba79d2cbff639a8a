# Completes the options of the commands in fish. They come from --help, so they are those of the installed version.
for pcl_bv_command in pcd_bv pcd_bv_mpi bv_stream synth
    complete -c $pcl_bv_command -n 'string match -q -- "-*" (commandline -ct)' \
        -a "($pcl_bv_command --help 2>/dev/null | string match -ra -- '--[a-z][a-z0-9-]*' | sort -u)"
end
