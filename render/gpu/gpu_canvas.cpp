#include "render/gpu/gpu_canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Pixels per draw call, between which drawing can be stopped. Some systems kill drivers that draw
// for long without a pause.
constexpr int k_pixels_at_once = 1 << 18;
constexpr int k_targets = 3;
constexpr std::array k_sum_samplers{"u_sum", "u_balance", "u_length"};
constexpr std::array<GLint, k_targets> k_formats{GL_RGBA32F, GL_RGBA32F, GL_R32F};

constexpr const char* k_instead = ": say engine = \"beams\"";

GLuint compiled(const GlFunctions& gl, GLenum kind, const std::string& source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) return shader;
    std::array<char, 400> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()) - 1, nullptr, log.data());
    gl.DeleteShader(shader);
    throw InternalError(fmt::format("the GL driver does not compile the kernel: {}", log.data()));
}

GLuint linked(const GlContext& context, const std::string& vertex, const std::string& fragment) {
    const GlFunctions& gl = context.gl();
    const GLuint first = compiled(gl, GL_VERTEX_SHADER, vertex);
    const GLuint second = compiled(gl, GL_FRAGMENT_SHADER, fragment);
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, first);
    gl.AttachShader(program, second);
    gl.LinkProgram(program);
    gl.DeleteShader(first);
    gl.DeleteShader(second);
    GLint good = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &good);
    if (good == GL_TRUE) return program;
    gl.DeleteProgram(program);
    throw InputError(fmt::format("the GL driver {} has no room for this stone and its lights{}",
                                 context.renderer(), k_instead));
}

}  // namespace

struct GpuCanvas::Objects {
    explicit Objects(const GlContext& of) : context(of), gl(of.gl()) {}
    ~Objects() {
        gl.DeleteProgram(program);
        gl.DeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
        gl.DeleteFramebuffers(2, framebuffers.data());
        gl.DeleteVertexArrays(1, &vertices);
    }
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    // Binds it to `unit`.
    GLuint texture(int unit, GLint format, int width, int height, const float* values) {
        GLuint name = 0;
        gl.GenTextures(1, &name);
        textures.push_back(name);
        gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
        gl.BindTexture(GL_TEXTURE_2D, name);
        gl.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0,
                      format == GL_R32F ? GL_RED : GL_RGBA, GL_FLOAT, values);
        for (const auto& [what, value] :
             {std::pair<GLenum, GLint>{GL_TEXTURE_MIN_FILTER, GL_NEAREST},
              {GL_TEXTURE_MAG_FILTER, GL_NEAREST},
              {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
              {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}})
            gl.TexParameteri(GL_TEXTURE_2D, what, value);
        return name;
    }
    void set_int(const char* name, GLint value) const {
        gl.Uniform1iv(gl.GetUniformLocation(program, name), 1, &value);
    }

    const GlContext& context;
    const GlFunctions& gl;
    GLuint program = 0, vertices = 0;
    std::vector<GLuint> textures;
    std::array<GLuint, 2> framebuffers{};
    std::array<std::array<GLuint, k_targets>, 2> targets{};
    int target_count = 1;
    std::size_t now = 0;  ///< index of the framebuffer drawn to
};

GpuCanvas::GpuCanvas(const GlContext& context, const GpuProgram& program, int width, int height,
                     bool balance)
    : objects_(std::make_unique<Objects>(context)),
      width_(width),
      height_(height),
      rows_(std::clamp(k_pixels_at_once / width, 1, height)) {
    Objects& o = *objects_;
    const GlFunctions& gl = o.gl;
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const auto require_size = [&](const char* what, int w, int h) {
        if (std::max(w, h) <= largest) return;
        throw InputError(fmt::format("{} of {} x {} is over what the GL driver {} takes, {}{}",
                                     what, w, h, context.renderer(), largest, k_instead));
    };
    require_size("a picture", width, height);
    o.program = linked(context, program.vertex, program.kernel);
    gl.UseProgram(o.program);
    gl.GenVertexArrays(1, &o.vertices);
    gl.BindVertexArray(o.vertices);
    o.target_count = balance ? k_targets : 1;
    gl.GenFramebuffers(2, o.framebuffers.data());
    constexpr std::array<GLenum, k_targets> k_attachments{
        GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    for (std::size_t i = 0; i < 2; ++i) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, o.framebuffers[i]);
        for (int t = 0; t < o.target_count; ++t) {
            const auto target = static_cast<std::size_t>(t);
            o.targets[i][target] = o.texture(t, k_formats[target], width, height, nullptr);
            gl.FramebufferTexture2D(GL_FRAMEBUFFER, k_attachments[target], GL_TEXTURE_2D,
                                    o.targets[i][target], 0);
        }
        gl.DrawBuffers(o.target_count, k_attachments.data());
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
            throw InputError(fmt::format("the GL driver {} does not draw to {} x {} floats{}",
                                         context.renderer(), width, height, k_instead));
        }
    }
    for (int t = 0; t < o.target_count; ++t)
        o.set_int(k_sum_samplers[static_cast<std::size_t>(t)], t);
    for (const GpuTexture& texture : program.textures) {
        require_size("an environment", texture.width, texture.height);
        o.texture(texture.unit, GL_RGBA32F, texture.width, texture.height, texture.rgba.data());
        o.set_int(texture.name.c_str(), texture.unit);
    }
    gl.Viewport(0, 0, width, height);
    gl.Enable(GL_SCISSOR_TEST);
    set(program.uniforms);
}

GpuCanvas::~GpuCanvas() = default;

void GpuCanvas::set(const std::vector<GpuUniform>& uniforms) {
    const GlFunctions& gl = objects_->gl;
    for (const GpuUniform& uniform : uniforms) {
        // Unused uniforms are optimised away: their location is -1, which GL ignores.
        const GLint place = gl.GetUniformLocation(objects_->program, uniform.name.c_str());
        const float* values = uniform.values.data();
        const auto count = static_cast<GLsizei>(uniform.values.size() /
                                                static_cast<std::size_t>(uniform.components));
        if (uniform.whole) {
            const std::vector<GLint> whole(uniform.values.begin(), uniform.values.end());
            gl.Uniform1iv(place, count, whole.data());
        } else if (uniform.components == 9) {
            gl.UniformMatrix3fv(place, count, GL_FALSE, values);
        } else {
            const auto function =
                std::array{gl.Uniform1fv, gl.Uniform2fv, gl.Uniform3fv,
                           gl.Uniform4fv}[static_cast<std::size_t>(uniform.components - 1)];
            function(place, count, values);
        }
    }
}

void GpuCanvas::begin() {
    Objects& o = *objects_;
    const float keep = keep_ ? 1.0f : 0.0f;
    o.gl.Uniform1fv(o.gl.GetUniformLocation(o.program, "u_keep"), 1, &keep);
    o.gl.BindFramebuffer(GL_FRAMEBUFFER, o.framebuffers[o.now]);
    for (int t = 0; t < o.target_count; ++t) {
        o.gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + t));
        o.gl.BindTexture(GL_TEXTURE_2D, o.targets[1 - o.now][static_cast<std::size_t>(t)]);
    }
}

void GpuCanvas::draw_rows(int row) {
    const GlFunctions& gl = objects_->gl;
    gl.Scissor(0, row, width_, std::min(rows_, height_ - row));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Finish();
}

void GpuCanvas::end() {
    objects_->now = 1 - objects_->now;
    keep_ = true;
}

std::vector<float> GpuCanvas::read(int target) const {
    const Objects& o = *objects_;
    const std::size_t row = 4 * static_cast<std::size_t>(width_);
    std::vector<float> upside_down(row * static_cast<std::size_t>(height_)),
        rgba(upside_down.size());
    // The framebuffer drawn last.
    o.gl.BindFramebuffer(GL_FRAMEBUFFER, o.framebuffers[1 - o.now]);
    o.gl.ReadBuffer(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + target));
    o.gl.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, upside_down.data());
    if (const GLenum error = o.gl.GetError(); error != GL_NO_ERROR) {
        throw InputError(fmt::format("the GL driver {} gave up (error {:#x}){}",
                                     o.context.renderer(), error, k_instead));
    }
    for (int y = 0; y < height_; ++y) {
        std::copy_n(upside_down.begin() + static_cast<std::ptrdiff_t>(row) * y, row,
                    rgba.begin() + static_cast<std::ptrdiff_t>(row) * (height_ - 1 - y));
    }
    return rgba;
}

}  // namespace culet
