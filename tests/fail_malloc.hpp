#pragma once

// What tests/fail_malloc.cpp offers programs that are linked with it.
extern "C" {

/// Lets the allocation fail that is the `number`th from now, 1 or above; 0 lets none fail any more.
/// Returns whether the one that was to fail before has failed.
bool fail_malloc_at(long number);

/// Blocks of memory that have been allocated and not freed.
long live_blocks();
}
