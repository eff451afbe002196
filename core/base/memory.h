#pragma once

namespace foresight {

/// What was freed goes back to the system: after a scan, that is its lines and images. Of the heap
/// that the program uses: jemalloc's (docs/adr/0025-jemalloc.md) or the C library's.
void GiveMemoryBack();

/// For a program of many threads that lives for days and has the C library's heap, called before
/// they start: each of its arenas (8 a core by itself) keeps the most that its threads ever had.
void KeepFewArenas();

}  // namespace foresight
