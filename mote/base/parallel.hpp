#pragma once
/// Independent pieces of work, side by side.

#include <cstddef>
#include <functional>

namespace mote {

/// Calls work(0), ..., work(count - 1) on so many threads, each piece once, in about this order.
///
/// error   what a call throws, the first of them; pieces that nobody has begun by then are left out
void in_parallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work);

}  // namespace mote
