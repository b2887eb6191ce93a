// SPDX-License-Identifier: Apache-2.0
// IFA_SANITIZED is defined where the address or the thread sanitiser watches: g++ and clang say so
// in different ways.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IFA_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IFA_SANITIZED
#endif
#endif
