#pragma once
// Films by an encoder that the machine has: ffmpeg, started as a program of its own. Nothing of it is linked.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace fascicle {

/// The `ffmpeg` of $PATH; empty when there is none.
std::filesystem::path find_video_encoder();

/// Hands raw pictures to the encoder, which makes an H.264 film (yuv420p, which every player shows) in an mp4 file.
class VideoEncoder {
public:
    /// width, height: even, 2 to 16384. cancel: looked at while waiting for the encoder; may be null. Error naming the file when
    /// the encoder cannot be started or the folder cannot be written to.
    VideoEncoder(const std::filesystem::path& encoder, std::filesystem::path file, int width, int height,
                 double fps, const std::atomic<bool>* cancel = nullptr);
    /// Without commit() the encoder is stopped and nothing is left behind.
    ~VideoEncoder();
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;

    /// 4 * width * height bytes, rows from the top; alpha is passed over. Error with the encoder's own words when it has ended;
    /// Cancelled.
    void add(const std::uint8_t* rgba);
    /// Waits for the encoder, and gives the film its name. Error with the encoder's own words.
    void commit();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fascicle
