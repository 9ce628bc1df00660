// Gives every thread of the program, those of libraries too, a stack on which its crash is handled
// (device/last_stop.h). It defines pthread_create(), which all of them call then instead of that of
// the C library.
#include <cerrno>
#include <cstddef>
#include <memory>
#include <new>

#include <dlfcn.h>
#include <pthread.h>

#include <palpate/device/last_stop.h>

namespace {

using ThreadFunction = void* (*)(void*);

// A smaller stack has no room for another one.
constexpr std::size_t kMinimumStackBytes = 256 * 1024;

struct ThreadStart {
  ThreadFunction function;
  void* argument;
};

void* runWithCrashStack(void* given) {
  const ThreadStart start = *std::unique_ptr<ThreadStart>(static_cast<ThreadStart*>(given));
  const palpate::CrashStack stack;
  return start.function(start.argument);
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread,
                              const pthread_attr_t* attributes,
                              ThreadFunction function,
                              void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, ThreadFunction, void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  std::size_t stackBytes = kMinimumStackBytes;
  if (attributes && ::pthread_attr_getstacksize(attributes, &stackBytes) == 0 &&
      stackBytes < kMinimumStackBytes)
    return create(thread, attributes, function, argument);
  std::unique_ptr<ThreadStart> start(new (std::nothrow) ThreadStart{function, argument});
  if (!start) return EAGAIN;
  const int error = create(thread, attributes, &runWithCrashStack, start.get());
  if (error == 0) start.release();
  return error;
}
