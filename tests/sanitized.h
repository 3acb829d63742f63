// SB_SANITIZED: true in a build with the address or thread sanitizer, where times and memory say
// nothing.
#pragma once

#include <stdbool.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SB_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SB_SANITIZED true
#endif
#endif
#ifndef SB_SANITIZED
#define SB_SANITIZED false
#endif
