#include "testing/counted_allocations.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
bool counting = false;
int allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// A sanitizer refuses a delete of ours for memory of its own new.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (counting) ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace palpate::testing {

void countAllocations() {
  allocations = 0;
  counting = true;
}
int allocationsCounted() {
  counting = false;
  return allocations;
}

}  // namespace palpate::testing
