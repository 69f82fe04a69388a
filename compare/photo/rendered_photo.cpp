#include "compare/photo/rendered_photo.h"

namespace culet {

Photo photo_of(const Picture& picture) {
    Photo photo;
    photo.width = picture.width;
    photo.height = picture.height;
    photo.rgb = picture.rgb;
    photo.coverage = picture.coverage;
    photo.encoding = "render";
    return photo;
}

}  // namespace culet
