#pragma once

// Functions of tests/fail_malloc.cpp for programs linked with it.
extern "C" {

/// Makes the allocation fail that is the `number`th from now, 1 or above; after 0 none fails.
/// Returns whether the previously chosen allocation has failed.
bool fail_malloc_at(long number);

/// The number of blocks of memory that are allocated and not freed.
long live_blocks();
}
