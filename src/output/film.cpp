#include "output/film.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/gif_file.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/video_encoder.hpp"
#include "output/staged_files.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::output {
namespace fs = std::filesystem;

namespace {

class OnePicture : public Film {
public:
    explicit OnePicture(fs::path target) : target_(std::move(target)) {}
    void add(const render::Image& image, int) override { image_ = image; }
    void finish(const JobControl&) override {
        write_png(target_, image_.width, image_.height, image_.rgba.data());
    }

private:
    fs::path target_;
    render::Image image_;
};

class NumberedPictures : public Film {
public:
    NumberedPictures(const fs::path& folder, ScenePtr scene) : scene_(std::move(scene)), files_(folder) {
        stem_ = folder.has_filename() ? folder.filename().string() : folder.parent_path().filename().string();
    }
    void add(const render::Image& image, int frame) override {
        char number[24];
        std::snprintf(number, sizeof number, "_%04d.png", frame);
        write_png(files_.place() / (stem_ + number), image.width, image.height, image.rgba.data());
    }
    void finish(const JobControl&) override { files_.commit(*scene_); }

private:
    ScenePtr scene_;
    StagedFiles files_;
    std::string stem_;
};

class GifFilm : public Film {
public:
    explicit GifFilm(const ExportRequest& request) : request_(request) {}
    int samples() const override { return 8; }
    void sample(const render::Image& image) override {
        sampler_.add(image.rgba.data(), image.rgba.size() / 4);
    }
    void add(const render::Image& image, int) override {
        if (writer_ == nullptr)
            writer_ = std::make_unique<GifWriter>(
                request_.target, image.width, image.height, sampler_.choose(),
                GifOptions{std::min(request_.fps, gif_most_fps), request_.dither});
        writer_->add(image.rgba.data());
    }
    void finish(const JobControl&) override { writer_->commit(); }

private:
    ExportRequest request_;
    PaletteSampler sampler_;
    std::unique_ptr<GifWriter> writer_;
};

class VideoFilm : public Film {
public:
    VideoFilm(const ExportRequest& request, const std::atomic<bool>* cancel)
        : request_(request), cancel_(cancel), encoder_path_(find_video_encoder()) {
        if (encoder_path_.empty())
            throw_error(request.target.string(), "there is no film encoder on this machine",
                        "ffmpeg (Debian: apt install ffmpeg); or a GIF, or numbered pictures");
    }
    void add(const render::Image& image, int) override {
        if (encoder_ == nullptr)
            encoder_ = std::make_unique<VideoEncoder>(encoder_path_, request_.target, image.width,
                                                      image.height, request_.fps, cancel_);
        encoder_->add(image.rgba.data());
    }
    void finish(const JobControl&) override { encoder_->commit(); }

private:
    ExportRequest request_;
    const std::atomic<bool>* cancel_;
    fs::path encoder_path_;
    std::unique_ptr<VideoEncoder> encoder_;
};

} // namespace

std::unique_ptr<Film> make_film(const ExportRequest& request, ScenePtr scene,
                                const std::atomic<bool>* cancel) {
    if (!export_kind(request.kind).traits.folder)
        check_no_input(request.target, *scene);
    if (request.kind == "picture")
        return std::make_unique<OnePicture>(request.target);
    if (request.kind == "frames")
        return std::make_unique<NumberedPictures>(request.target, std::move(scene));
    if (request.kind == "gif")
        return std::make_unique<GifFilm>(request);
    FASCICLE_ASSERT(request.kind == "video");
    return std::make_unique<VideoFilm>(request, cancel);
}

} // namespace fascicle::output
