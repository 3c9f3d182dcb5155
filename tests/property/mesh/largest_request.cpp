#include "property/mesh/largest_request.h"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PLUMB_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PLUMB_SANITIZED
#endif
#endif

namespace {

std::atomic<std::size_t> largest{0};

void count(std::size_t size) {
  std::size_t before = largest;
  while (size > before && !largest.compare_exchange_weak(before, size)) {
  }
}

}  // namespace

namespace plumb::test_support {

void forget_requests() { largest = 0; }
std::size_t largest_request() { return largest; }

}  // namespace plumb::test_support

#ifdef PLUMB_SANITIZED

// A sanitizer has `new` of its own, and must see both ends of what a library asks for. Of its
// runtime; gcc brings no header for it.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {

void count_request(const volatile void*, std::size_t size) { count(size); }
void ignore(const volatile void*) {}
[[maybe_unused]] const int installed =
    __sanitizer_install_malloc_and_free_hooks(count_request, ignore);

}  // namespace

#else

void* operator new(std::size_t size) {
  count(size);
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif
