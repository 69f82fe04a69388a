#include "render/gpu/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <vector>

#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::size_t k_longest_name = 100;

[[noreturn]] void no_driver(const std::string& why) {
    throw InputError(
        fmt::format("engine gpu needs an OpenGL ES 3 driver, and {}: install one (Debian: apt "
                    "install libegl1 libgl1-mesa-dri), or say engine = \"beams\"",
                    why));
}

// The library stays loaded: drivers may not survive unloading.
struct Egl {
    Egl() {
        void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) no_driver("there is no libEGL.so.1");
        const auto find = [library](const char* name, auto& function) {
            function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
            if (function == nullptr) no_driver(fmt::format("libEGL.so.1 has no {}", name));
        };
        find("eglBindAPI", BindAPI);
        find("eglChooseConfig", ChooseConfig);
        find("eglCreateContext", CreateContext);
        find("eglDestroyContext", DestroyContext);
        find("eglGetProcAddress", GetProcAddress);
        find("eglInitialize", Initialize);
        find("eglMakeCurrent", MakeCurrent);
        find("eglQueryString", QueryString);
    }
    decltype(&eglBindAPI) BindAPI = nullptr;
    decltype(&eglChooseConfig) ChooseConfig = nullptr;
    decltype(&eglCreateContext) CreateContext = nullptr;
    decltype(&eglDestroyContext) DestroyContext = nullptr;
    decltype(&eglGetProcAddress) GetProcAddress = nullptr;
    decltype(&eglInitialize) Initialize = nullptr;
    decltype(&eglMakeCurrent) MakeCurrent = nullptr;
    decltype(&eglQueryString) QueryString = nullptr;

    bool has(EGLDisplay display, const char* extension) const {
        const char* all = QueryString(display, EGL_EXTENSIONS);
        return all != nullptr && std::string(all).find(extension) != std::string::npos;
    }
};

const Egl& egl() {
    static const Egl loaded;
    return loaded;
}

// Windowless displays, hardware first.
std::vector<EGLDisplay> displays_of(const Egl& e) {
    std::vector<EGLDisplay> hardware, software;
    const auto open = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        e.GetProcAddress("eglGetPlatformDisplayEXT"));
    if (open == nullptr) return {};
    const auto query =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(e.GetProcAddress("eglQueryDevicesEXT"));
    const auto describe = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        e.GetProcAddress("eglQueryDeviceStringEXT"));
    if (e.has(EGL_NO_DISPLAY, "EGL_EXT_platform_device") && query != nullptr &&
        describe != nullptr) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (query(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
            for (EGLint i = 0; i < count; ++i) {
                const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
                const char* what = describe(device, EGL_EXTENSIONS);
                const bool computes =
                    what != nullptr &&
                    std::string(what).find("EGL_MESA_device_software") != std::string::npos;
                (computes ? software : hardware)
                    .push_back(open(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
            }
        }
    }
    if (e.has(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        hardware.push_back(open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

// Makes an OpenGL ES 3 context current; EGL_NO_CONTEXT if the display cannot.
EGLContext context_of(const Egl& e, EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || e.Initialize(display, nullptr, nullptr) != EGL_TRUE ||
        e.BindAPI(EGL_OPENGL_ES_API) != EGL_TRUE)
        return EGL_NO_CONTEXT;
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!e.has(display, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0,
                                 EGL_NONE};
        EGLint found = 0;
        if (e.ChooseConfig(display, wanted, &config, 1, &found) != EGL_TRUE || found < 1)
            return EGL_NO_CONTEXT;
    }
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLContext context = e.CreateContext(display, config, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
    if (e.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return context;
    e.DestroyContext(display, context);
    return EGL_NO_CONTEXT;
}

// The name is printed to terminals and files.
std::string printable(const char* text) {
    std::string clean;
    for (; text != nullptr && *text != 0 && clean.size() < k_longest_name; ++text)
        clean += *text >= ' ' && *text <= '~' ? *text : '?';
    return clean.empty() ? "a driver without a name" : clean;
}

}  // namespace

GlContext::GlContext() {
    const Egl& e = egl();
    for (EGLDisplay display : displays_of(e)) {
        context_ = context_of(e, display);
        display_ = display;
        if (context_ != nullptr) break;
    }
    if (context_ == nullptr) no_driver("EGL finds none that draws without a window");
    const auto find = [&e](const char* name, auto& function) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(e.GetProcAddress(name));
        if (function == nullptr) no_driver(fmt::format("this one has no {}", name));
    };
#define CULET_GL_FUNCTION(name) find("gl" #name, gl_.name);
    CULET_GL_FUNCTIONS(CULET_GL_FUNCTION)
#undef CULET_GL_FUNCTION
    renderer_ = printable(reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER)));
}

// Keeps the display open: other users of EGL in this process share it.
GlContext::~GlContext() {
    egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl().DestroyContext(display_, context_);
}

}  // namespace culet
