#pragma once
// The part of zlib that tinyexr needs, done by stb_image's decoder (picture_decoder.cpp). Pages do
// not write EXR.

using uLong = unsigned long;
using Bytef = unsigned char;
enum { Z_OK = 0, Z_DATA_ERROR = -3 };

int uncompress(Bytef* to, unsigned long* size, const Bytef* from, uLong count);
inline uLong compressBound(uLong size) {
    return size;
}
inline int compress(Bytef*, uLong*, const Bytef*, uLong) {
    return Z_DATA_ERROR;
}
