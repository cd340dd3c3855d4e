/* Loading a shared library and finding its functions, on Windows and everywhere else. */

#ifndef LIBRARY_H
#define LIBRARY_H

#ifdef _WIN32

#include <stdio.h>
#include <windows.h>

typedef HMODULE Library;

static Library load_library(const char *path) {
    char native[MAX_PATH];
    size_t i = 0;
    /* LoadLibrary wants backslashes. */
    for (; path[i] && i + 1 < sizeof native; i++) native[i] = path[i] == '/' ? '\\' : path[i];
    native[i] = 0;
    return LoadLibraryA(native);
}

static void *library_symbol(Library library, const char *name) {
    return (void *)GetProcAddress(library, name);
}

static const char *loading_error(void) {
    static char text[32];
    snprintf(text, sizeof text, "Windows error %lu", GetLastError());
    return text;
}

#else

#include <dlfcn.h>

typedef void *Library;

static Library load_library(const char *path) {
    return dlopen(path, RTLD_NOW | RTLD_LOCAL);
}

static void *library_symbol(Library library, const char *name) {
    return dlsym(library, name);
}

static const char *loading_error(void) {
    return dlerror();
}

#endif
#endif
