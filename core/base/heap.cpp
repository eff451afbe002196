// jemalloc is the heap of the programs that link this file (foresight_heap), libraries included:
// docs/adr/0025-jemalloc.md. Where huge pages are to be had, scans and images lie in them.
#include <jemalloc/jemalloc.h>

// Read by jemalloc before main; MALLOC_CONF in the environment overrides it.
const char* malloc_conf = "thp:always";
