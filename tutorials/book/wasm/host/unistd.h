#pragma once
// There is no other program to become.
#include_next <unistd.h>
#ifdef __cplusplus
extern "C" int execv(const char*, char* const*);
#endif
