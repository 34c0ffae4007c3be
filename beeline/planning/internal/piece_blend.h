#pragma once

#include <vector>

#include <beeline/planning/internal/move_piece.h>

namespace beeline::internal {

/// The blend between two pieces: the quintic polynomial in joint space that replaces the end of the
/// one and the beginning of the other, with their first and second derivatives at its ends. With
/// lengths 0 the arm stops.
struct PieceBlend {
  double before = 0, after = 0;  ///< lengths of the joint paths that it replaces, rad or m
  bool asked_for = false;        ///< whether the program asks for a blend
  Reason reason = {};            ///< why it is smaller than the program allows, or a stop

  double radius() const { return before > after ? before : after; }
  bool stops() const { return before == 0; }
};

/// Returns the largest blend between two pieces that deviates from both, at equal parameters, by no
/// more than the blend after `move` allows, and replaces at most a half of each.
PieceBlend largest_piece_blend(const Arm& arm, const Task& task, const Move& move,
                               const MovePiece& before, const MovePiece& after);

/// Returns the blend with half of the lengths, or a stop where it would be too small, for a reason.
PieceBlend halved(const PieceBlend& blend, const MovePiece& before, const MovePiece& after,
                  const Reason& reason);

/// Returns the joint path along pieces from stop to stop; blends[k] is between piece k and the
/// next. Its parameter is the length of the pieces' paths: waypoint k is at the sum of the lengths
/// up to piece k.
JointPath joined(const std::vector<const MovePiece*>& pieces,
                 const std::vector<PieceBlend>& blends);

}  // namespace beeline::internal
