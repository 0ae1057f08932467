#ifndef touchstone_vectorised_h
#define touchstone_vectorised_h

/** A function of which the compiler makes versions for newer processors too, from which the
 * dynamic linker chooses: programs of distributions know the first x86-64 only. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define TOUCHSTONE_VECTORISED __attribute__((target_clones("arch=haswell", "default")))
#else
#define TOUCHSTONE_VECTORISED
#endif

#endif
