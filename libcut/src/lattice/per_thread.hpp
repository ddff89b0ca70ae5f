/// @file
/// Variables of functions that every thread has for itself: working memory that is kept from one call to the
/// next. Where there are no threads they are static, since WASI's C++ library cannot end the life of others.
#pragma once

#if defined(__wasi__) && !defined(_REENTRANT)
#define SNIP_PER_THREAD static
#else
#define SNIP_PER_THREAD thread_local
#endif
