#include "core/procedural/chess.h"

#include <array>

#include "core/base/error.h"
#include "core/base/fixed_random.h"
#include "core/procedural/chess_board.h"
#include "core/procedural/chess_knight.h"
#include "core/procedural/chess_position.h"
#include "core/procedural/choose_mirrors.h"

namespace hybridrt {
namespace {

/// Parts that are built once and copied.
struct Kit {
  Fineness fineness;
  std::array<std::vector<std::vector<Patch>>, kChessPieces> pieces;
  std::vector<Patch> square, core, stringing, frame, table;
};

Kit make_kit(double per_turn) {
  Kit kit;
  kit.fineness = {per_turn, 0.7 * per_turn};
  for (int i = 0; i < kChessPieces; ++i) kit.pieces[i] = turned_parts(static_cast<ChessPiece>(i), kit.fineness);
  // Flat parts need fewer.
  const Fineness coarse{0.5 * per_turn + 16, 0.1 * per_turn};
  kit.square = board_square(coarse), kit.core = board_core(coarse), kit.stringing = board_stringing(coarse);
  kit.frame = board_frame(coarse), kit.table = table_round({2 * per_turn, 0.2 * per_turn}, 1);
  return kit;
}

/// Triangles of a knight's head: more than turned work has, for its details.
int64_t knight_triangles(const Fineness& fineness) {
  const double square = fineness.per_turn * fineness.per_turn;
  return static_cast<int64_t>(std::max(700.0, std::min(10 * square, 16'000 + 4 * square)));
}

/// Triangles of the whole scene, if a knight's head has `knight`.
int64_t count_kit(const Kit& kit, const std::vector<ChessMan>& men, int64_t knight) {
  int64_t count = 64 * count_triangles(kit.square) + count_triangles(kit.core) + count_triangles(kit.stringing) +
                  count_triangles(kit.frame) + count_triangles(kit.table);
  for (const ChessMan& man : men) {
    for (const auto& part : kit.pieces[static_cast<int>(man.piece)]) count += count_triangles(part);
    count += man.piece == ChessPiece::knight ? knight : 0;
  }
  return count;
}

/// The finest kit with fewer than `triangles`.
Kit fit_kit(const std::vector<ChessMan>& men, int64_t triangles) {
  double lo = 6, hi = 4000;
  while (hi - lo > 1e-3 * lo) {
    const double middle = std::sqrt(lo * hi);
    const Kit kit = make_kit(middle);
    (count_kit(kit, men, knight_triangles(kit.fineness)) <= triangles ? lo : hi) = middle;
  }
  return make_kit(lo);
}

/// A closed surface and its place.
struct Solid {
  const TriangleMesh* mesh;
  Placement placement;
  std::function<uint32_t(bool mirror)> material;
};

}  // namespace

Scene make_chess(const ChessOptions& options) {
  const std::vector<ChessMan> men = immortal_game();
  Kit kit = fit_kit(men, options.triangles);
  const TriangleMesh knight = carve_knight(knight_triangles(kit.fineness));
  // The triangles left over go into the table's top.
  const int64_t count = count_kit(kit, men, static_cast<int64_t>(knight.triangle_positions.size()));
  const int64_t ring = int64_t{2} * kit.table.back().columns;
  kit.table.back().rows += static_cast<int>(std::max<int64_t>(0, (options.triangles - count + ring / 2) / ring));

  const TriangleMesh square = mesh_of(kit.square), core = mesh_of(kit.core), stringing = mesh_of(kit.stringing),
                     frame = mesh_of(kit.frame), table = mesh_of(kit.table);
  std::array<std::vector<TriangleMesh>, kChessPieces> pieces;
  for (int i = 0; i < kChessPieces; ++i)
    for (const auto& part : kit.pieces[i]) pieces[i].push_back(mesh_of(part));
  pieces[static_cast<int>(ChessPiece::knight)].push_back(knight);

  Scene scene;
  scene.triangle_positions.reserve(options.triangles + options.triangles / 20);
  ChessMaterials materials(scene, options.reflective_percent.has_value());
  std::vector<Solid> components;
  const auto add = [&](const TriangleMesh& mesh, const Placement& placement, const char* name) {
    components.push_back({&mesh, placement, [&, name](bool mirror) { return materials.find(name, mirror); }});
  };
  add(table, {}, "table");
  add(core, {}, "frame");
  add(frame, {}, "frame");
  add(stringing, {}, "stringing");
  uint64_t state = 64;
  for (int rank = 0; rank < 8; ++rank)
    for (int file = 0; file < 8; ++file) {
      constexpr const char* kWoods[2][3] = {{"walnut", "walnut_dark", "walnut_red"},
                                            {"maple", "maple_pale", "maple_warm"}};
      add(square, {{file - 3.5, 0, 3.5 - rank}, 0}, kWoods[(file + rank) % 2][next_random(state) % 3]);
    }
  for (const ChessMan& man : men)
    for (const TriangleMesh& part : pieces[static_cast<int>(man.piece)]) {
      const double height = (man.captured ? -kBoardHeight : 0) + kAirUnderPieces;
      components.push_back({&part, {{man.place.x, height, man.place.y}, man.turn_deg * kPi / 180}, [&](bool mirror) {
                              return materials.of_piece(man.white, man.finish, mirror);
                            }});
    }

  const std::vector<char> is_mirror =
      choose_mirrors(static_cast<int>(components.size()), options.reflective_percent.value_or(0));
  for (size_t i = 0; i < components.size(); ++i)
    add_mesh(scene, *components[i].mesh, components[i].placement, components[i].material(is_mirror[i]));
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

SceneShot chess_shot() {
  SceneShot shot;
  Camera camera;
  camera.eye_world = {-2.9, 3.4, 9.6};
  camera.target_world = {0.1, -0.1, 0.35};
  camera.fov_y_rad = 38 * kPi / 180;
  shot.camera = camera;
  shot.lights = {DirectionalLight{glm::normalize(dvec3(-1, 0.9, 0.3)), vec3(1)}};
  shot.background = vec3(0.045f, 0.060f, 0.078f);
  shot.ambient = vec3(0.20f, 0.205f, 0.215f);
  return shot;
}

}  // namespace hybridrt
