#pragma once
/// Containers of video: what a file says of its own length.

#include <string>

namespace mote::vision {

/// What the bytes of a video file tell without decoding it.
struct Container {
  bool counts =
      false;         ///< it lists its frames (AVI, MP4 and its kin); the count of any other is a guess from durations
  bool cut = false;  ///< it ends before it says it does: a copy broke off
};

/// Reads the sizes that the file's outermost parts state: RIFF chunks (AVI), boxes (MP4, MOV), the segment of Matroska
/// and WebM. A size that was never filled in, as in a stream, says nothing. Any other format: neither counts nor cut.
///
/// error   none; a file that cannot be read says nothing
/// cost    one short read per outermost part
/// source  ISO/IEC 14496-12, 4.2 (boxes); RFC 8794, 4 and 6 (EBML)
Container container_of(const std::string& path);

}  // namespace mote::vision
