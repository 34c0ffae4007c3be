#include <beeline/draw/paper.h>

namespace beeline {

void PaperPath::move(const PaperPoint& p) {
  verbs.push_back(Verb::move);
  points.push_back(p);
}

void PaperPath::line(const PaperPoint& p) {
  verbs.push_back(Verb::line);
  points.push_back(p);
}

void PaperPath::curve(const PaperPoint& a, const PaperPoint& b, const PaperPoint& p) {
  verbs.push_back(Verb::curve);
  points.insert(points.end(), {a, b, p});
}

void PaperPath::close() { verbs.push_back(Verb::close); }

}  // namespace beeline
