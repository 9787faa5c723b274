#pragma once
/// A clip that is drawn: a textured target on a textured scene, where it is known exactly.

#include <cstdint>
#include <filesystem>
#include <string>

namespace mote::reproduce {

/// Draws a clip of 320 x 240 grey pictures f0001.pgm ... and its truth truth.csv (frame,x,y,w,h) into a folder; returns
/// the first box as for --init.
///
///   centre  (160 + 50 sin(2 pi t/90 + a), 120 + 30 sin(2 pi t/60 + b)) px,   t the frame from 0 on; a, b by the seed
///   sides   48 x 40 px
///
/// Textures are random grey levels 12 px (scene) and 7 px (target) apart, smoothly joined; every pixel has Gaussian
/// noise of 4 levels. The target moves by at most 5 px a frame.
///
/// error   Refusal (kCannotWrite)
/// cost    some ms a frame
std::string draw_clip(const std::filesystem::path& folder, int frames, std::uint64_t seed);

}  // namespace mote::reproduce
