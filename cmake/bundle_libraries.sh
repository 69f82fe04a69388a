#!/bin/sh
# bundle_libraries.sh BINARY FOLDER: copies the shared libraries that the binary needs, with their licences, into the
# folder, and makes the binary look for them there. The C library stays the system's: it must not be older than here.
# Needs patchelf.
set -eu
binary=$1
folder=$2
mkdir -p "$folder/licences"
ldd "$binary" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | while read -r library; do
    name=$(basename "$library")
    case $name in
        libc.so.* | libm.so.* | libdl.so.* | libpthread.so.* | librt.so.* | libresolv.so.* | ld-linux*) continue ;;
    esac
    cp -L "$library" "$folder/$name"
    chmod 644 "$folder/$name"
    patchelf --set-rpath "\$ORIGIN" "$folder/$name"
    # dpkg knows the files under the names that they had before /lib became a link.
    package=$(dpkg-query -S "$(readlink -f "$library")" "/usr$(readlink -f "$library")" 2>/dev/null |
        cut -d: -f1 | head -n 1) || true
    if [ -n "$package" ]; then cp -L "/usr/share/doc/$package/copyright" "$folder/licences/$package"; fi
done
patchelf --set-rpath "\$ORIGIN/$(realpath --relative-to="$(dirname "$binary")" "$folder")" "$binary"
