// SPDX-License-Identifier: Apache-2.0
//
// What jemalloc reads when a program starts. In a program that is linked with it, not in a library.

// jemalloc looks for a variable of this name. Where the system gives large pages to who asks for them, ask; what is
// freed is kept for a minute, large arrays included, for the next step of an operation.
extern "C" const char* malloc_conf;
const char* malloc_conf = "thp:always,dirty_decay_ms:60000,oversize_threshold:0";
