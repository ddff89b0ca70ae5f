// Animated WebP by libwebp, see image_file.hpp. Pictures are large even faces with thin lines: lossless
// compression keeps the lines sharp, and at its second level a frame takes a third less space than at the
// fastest.
#include <webp/encode.h>
#include <webp/mux.h>

#include "snip/render/image_file.hpp"

namespace snip {
namespace {

struct DeleteEncoder {
  void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

}  // namespace

struct Animation::Encoder {
  std::unique_ptr<WebPAnimEncoder, DeleteEncoder> webp;
  WebPConfig config;
  int time = 0;  // milliseconds up to the next picture
};

Animation::Animation(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
Animation::Animation(Animation&&) noexcept = default;
Animation& Animation::operator=(Animation&&) noexcept = default;
Animation::~Animation() = default;

Result<Animation> Animation::create(std::size_t width, std::size_t height) {
  if (width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION)
    return Error{"an animation can be at most 16383 pixels wide and high"};
  auto encoder = std::make_unique<Encoder>();
  WebPAnimEncoderOptions options;
  if (!WebPConfigInit(&encoder->config) || !WebPConfigLosslessPreset(&encoder->config, 1) ||
      !WebPAnimEncoderOptionsInit(&options))
    return Error{"libwebp does not fit the version that this program was built with"};
  options.anim_params.loop_count = 0;
  encoder->webp.reset(WebPAnimEncoderNew(static_cast<int>(width), static_cast<int>(height), &options));
  if (!encoder->webp) return Error{"not enough memory for the animation"};
  return Animation(std::move(encoder));
}

Result<> Animation::add(const Image& image, int milliseconds) {
  WebPPicture picture;
  WebPPictureInit(&picture);
  picture.use_argb = 1;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  const bool good = WebPPictureImportRGB(&picture, image.rgb.data(), 3 * picture.width) &&
                    WebPAnimEncoderAdd(encoder_->webp.get(), &picture, encoder_->time, &encoder_->config);
  WebPPictureFree(&picture);
  if (!good)
    return Error{std::string("the animation could not take a picture: ") +
                 WebPAnimEncoderGetError(encoder_->webp.get())};
  encoder_->time += milliseconds;
  return {};
}

Result<std::vector<std::uint8_t>> Animation::finish() {
  WebPData data;
  WebPDataInit(&data);
  WebPAnimEncoder* webp = encoder_->webp.get();
  if (!WebPAnimEncoderAdd(webp, nullptr, encoder_->time, nullptr) || !WebPAnimEncoderAssemble(webp, &data))
    return Error{std::string("the animation could not be put together: ") + WebPAnimEncoderGetError(webp)};
  std::vector<std::uint8_t> bytes(data.bytes, data.bytes + data.size);
  WebPDataClear(&data);
  return bytes;
}

}  // namespace snip
