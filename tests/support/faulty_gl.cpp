// libEGL.so.1 and libOSMesa.so.8 of a driver with faults: everything goes on to the real libraries (FAULTY_GL_EGL,
// FAULTY_GL_OSMESA: their paths), but for what FAULTY_GL says. Claims to be a GPU. Loaded by
// tests/cli/gl_driver_test.py.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <unistd.h>

namespace {

bool has_fault(const char* name) {
  const char* fault = std::getenv("FAULTY_GL");
  return fault && std::strcmp(fault, name) == 0;
}

void fail_at(const char* place) {
  if (has_fault("hang") && std::strcmp(place, "open") == 0) ::pause();
  if (has_fault("abort") && std::strcmp(place, "open") == 0) {
    std::fprintf(stderr, "faulty driver: assertion failed\n");
    std::abort();
  }
  char crash[64];
  std::snprintf(crash, sizeof crash, "crash at %s", place);
  if (has_fault(crash)) {
    *static_cast<volatile int*>(nullptr) = 1;
  }
}

template <typename Function>
Function real(const char* library, const char* name) {
  void* const handle = ::dlopen(std::getenv(library), RTLD_NOW | RTLD_LOCAL);
  return reinterpret_cast<Function>(::dlsym(handle, name));
}

using Symbol = void (*)();
using Lookup = Symbol (*)(const char*);
using GetString = const unsigned char* (*)(unsigned);

GetString real_get_string = nullptr;

const unsigned char* get_string(unsigned name) {
  constexpr unsigned kRenderer = 0x1F01;
  return name == kRenderer ? reinterpret_cast<const unsigned char*>("Imaginary GPU") : real_get_string(name);
}

void draw_nothing(unsigned, int, int) {}
void compute_nothing(unsigned, unsigned, unsigned) {}

const char* device_string(void*, int) { return ""; }  // not EGL_MESA_device_software

unsigned query_devices(int most, void** devices, int* count) {
  fail_at("list");
  using Query = unsigned (*)(int, void**, int*);
  return reinterpret_cast<Query>(real<Lookup>("FAULTY_GL_EGL", "eglGetProcAddress")("eglQueryDevicesEXT"))(
      most, devices, count);
}

template <typename Function>
Symbol symbol(Function function) {
  return reinterpret_cast<Symbol>(function);
}

Symbol faulty(const char* name, Symbol found) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("glGetString")) {
    real_get_string = reinterpret_cast<GetString>(found);
    return symbol(get_string);
  }
  if (is("glDrawArrays") && has_fault("draws nothing")) return symbol(draw_nothing);
  if (is("glDispatchCompute") && has_fault("computes nothing")) return symbol(compute_nothing);
  if (is("eglQueryDeviceStringEXT")) return symbol(device_string);
  if (is("eglQueryDevicesEXT")) return symbol(query_devices);
  return found;
}

/// Each process that loads this, as a line of a log.
__attribute__((constructor)) void note_loading() {
  const char* log = std::getenv("FAULTY_GL_LOG");
  std::FILE* const words = log ? std::fopen("/proc/self/cmdline", "rb") : nullptr;
  if (!words) return;
  char text[4096];
  const size_t size = std::fread(text, 1, sizeof text - 1, words);
  std::fclose(words);
  for (size_t i = 0; i < size; ++i)
    if (text[i] == 0) text[i] = ' ';
  text[size] = 0;
  if (std::FILE* const lines = std::fopen(log, "a")) {
    std::fprintf(lines, "%s\n", text);
    std::fclose(lines);
  }
}

}  // namespace

extern "C" {

Symbol eglGetProcAddress(const char* name) {
  return faulty(name, real<Lookup>("FAULTY_GL_EGL", "eglGetProcAddress")(name));
}
const char* eglQueryString(void* display, int name) {
  return real<const char* (*)(void*, int)>("FAULTY_GL_EGL", "eglQueryString")(display, name);
}
int eglGetError() { return real<int (*)()>("FAULTY_GL_EGL", "eglGetError")(); }
unsigned eglInitialize(void* display, int* major, int* minor) {
  fail_at("open");
  return real<unsigned (*)(void*, int*, int*)>("FAULTY_GL_EGL", "eglInitialize")(display, major, minor);
}
unsigned eglBindAPI(unsigned api) { return real<unsigned (*)(unsigned)>("FAULTY_GL_EGL", "eglBindAPI")(api); }
void* eglCreateContext(void* display, void* config, void* share, const int* attributes) {
  return real<void* (*)(void*, void*, void*, const int*)>("FAULTY_GL_EGL", "eglCreateContext")(display, config, share,
                                                                                               attributes);
}
unsigned eglDestroyContext(void* display, void* context) {
  fail_at("close");
  return real<unsigned (*)(void*, void*)>("FAULTY_GL_EGL", "eglDestroyContext")(display, context);
}
unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
  return real<unsigned (*)(void*, void*, void*, void*)>("FAULTY_GL_EGL", "eglMakeCurrent")(display, draw, read,
                                                                                           context);
}

void* OSMesaCreateContextAttribs(const int* attributes, void* share) {
  fail_at("open");
  return real<void* (*)(const int*, void*)>("FAULTY_GL_OSMESA", "OSMesaCreateContextAttribs")(attributes, share);
}
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
  return real<unsigned char (*)(void*, void*, unsigned, int, int)>("FAULTY_GL_OSMESA", "OSMesaMakeCurrent")(
      context, buffer, type, width, height);
}
void OSMesaDestroyContext(void* context) {
  fail_at("close");
  real<void (*)(void*)>("FAULTY_GL_OSMESA", "OSMesaDestroyContext")(context);
}
Symbol OSMesaGetProcAddress(const char* name) {
  return faulty(name, real<Lookup>("FAULTY_GL_OSMESA", "OSMesaGetProcAddress")(name));
}
}
