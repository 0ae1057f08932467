#ifndef touchstone_base_vectorised_h
#define touchstone_base_vectorised_h

/** The compiler makes versions of the function for newer processors, of which the dynamic
 * linker chooses one when the program starts: distributions build for baseline x86-64. The
 * names of levels stand for all processors that have them; "arch=haswell" would stand for
 * this one alone. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
#  define TOUCHSTONE_VECTORISED \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#  define TOUCHSTONE_VECTORISED
#endif

#endif
