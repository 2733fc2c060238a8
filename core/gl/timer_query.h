#pragma once

#include "core/gl/objects.h"

namespace hybridrt::gl {

/// GPU time between two points of the command stream, from two GL_TIMESTAMP queries.
class TimerQuery {
 public:
  explicit TimerQuery(const Functions& gl) : begin_(gl, new_query(gl)), end_(gl, new_query(gl)), gl_(gl) {}

  void begin() {
    gl_.QueryCounter(begin_.id(), GL_TIMESTAMP);
    ran_ = true;
  }
  void end() { gl_.QueryCounter(end_.id(), GL_TIMESTAMP); }
  /// For a pass that this frame skips: elapsed_ms() is 0 then.
  void skip() { ran_ = false; }

  /// Waits for the GPU to reach end().
  double elapsed_ms() const {
    if (!ran_) return 0;
    GLuint64 begin_ns = 0, end_ns = 0;
    gl_.GetQueryObjectui64v(begin_.id(), GL_QUERY_RESULT, &begin_ns);
    gl_.GetQueryObjectui64v(end_.id(), GL_QUERY_RESULT, &end_ns);
    return static_cast<double>(end_ns - begin_ns) * 1e-6;
  }

 private:
  static GLuint new_query(const Functions& gl) {
    GLuint id = 0;
    gl.CreateQueries(GL_TIMESTAMP, 1, &id);
    return id;
  }
  Handle<&Functions::DeleteQueries> begin_, end_;
  const Functions& gl_;
  bool ran_ = false;
};

}  // namespace hybridrt::gl
