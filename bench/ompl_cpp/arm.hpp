// The two-link arm and its obstacles: exact, scalar, without allocation.
#pragma once

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <string>
#include <vector>

struct Point {
    double x, y;
};

inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

// A link: where it begins, a unit vector along it, its length.
struct Link {
    Point from, along;
    double length;
    Point end() const { return {from.x + length * along.x, from.y + length * along.y}; }

    double squaredDistance(Point p) const {
        const Point to = p - from;
        const double t = std::clamp(dot(to, along), 0.0, length);
        const Point off = {to.x - t * along.x, to.y - t * along.y};
        return dot(off, off);
    }
};

struct Edge {
    Point from, to, along;  // `along` has unit length.
    double length;
};

struct Circle {
    Point center;
    double radius, squared;
};

struct Polygon {
    Circle around;
    std::vector<Edge> edges;
};

// The base lies outside all polygons, so a link that crosses no edge is outside as well.
inline bool crosses(const Link &link, const Edge &edge) {
    const Point end = link.end();
    const double a = cross(link.along, edge.from - link.from), b = cross(link.along, edge.to - link.from);
    if ((a > 0) == (b > 0)) return false;
    const double c = cross(edge.along, link.from - edge.from), d = cross(edge.along, end - edge.from);
    return (c > 0) != (d > 0);
}

struct Arm {
    double lengths[2];
    double low[2], high[2];
    std::vector<Circle> circles;
    std::vector<Polygon> polygons;
    std::vector<std::pair<double, double>> starts, goals;

    void links(double q1, double q2, Link out[2]) const {
        double s, c;
        sincos(q1, &s, &c);
        out[0] = {{0, 0}, {c, s}, lengths[0]};
        sincos(q1 + q2, &s, &c);
        out[1] = {out[0].end(), {c, s}, lengths[1]};
    }

    // Whether the arm touches nothing: squared distances, and out at the first contact.
    bool free(double q1, double q2) const {
        Link both[2];
        links(q1, q2, both);
        for (const Circle &circle : circles)
            for (const Link &link : both)
                if (link.squaredDistance(circle.center) <= circle.squared) return false;
        for (const Polygon &polygon : polygons)
            for (const Link &link : both) {
                if (link.squaredDistance(polygon.around.center) > polygon.around.squared) continue;
                for (const Edge &edge : polygon.edges)
                    if (crosses(link, edge)) return false;
            }
        return true;
    }

    // Distance from a link to the nearest obstacle (m), 0 in contact; less than that where only a polygon is near, but
    // not very near.
    double clearance(const Link &link) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Circle &circle : circles)
            nearest = std::min(nearest, std::sqrt(link.squaredDistance(circle.center)) - circle.radius);
        for (const Polygon &polygon : polygons) {
            const Circle &around = polygon.around;
            const double away = std::sqrt(link.squaredDistance(around.center)) - around.radius;
            // Far away the circle around it will do.
            if (away > 2 * around.radius) {
                nearest = std::min(nearest, away);
                continue;
            }
            if (away >= nearest) continue;
            double squared = std::numeric_limits<double>::infinity();
            for (const Edge &edge : polygon.edges) {
                if (crosses(link, edge)) return 0;
                const Link side = {edge.from, edge.along, edge.length};
                squared = std::min({squared, link.squaredDistance(edge.from), side.squaredDistance(link.from),
                                    side.squaredDistance(link.end())});
            }
            nearest = std::min(nearest, std::sqrt(squared));
        }
        return std::max(nearest, 0.0);
    }

    // Whether the straight turn between two configurations is free, the whole of it: an interval is, where the
    // clearance in its middle is more than any point of the link moves to its ends; else it is halved.
    bool freeBetween(const double *a, const double *b) const {
        const double turn1 = std::fabs(b[0] - a[0]), turn2 = std::fabs(b[1] - a[1]);
        const double reach[2] = {turn1 * lengths[0], turn1 * (lengths[0] + lengths[1]) + turn2 * lengths[1]};
        return freeAround(a, b, 0.5, 0.5, reach);
    }

   private:
    static constexpr double kFloor = 1e-6;  // A motion this near to an obstacle is refused (m).

    bool freeAround(const double *a, const double *b, double middle, double half, const double reach[2]) const {
        Link both[2];
        links(a[0] + middle * (b[0] - a[0]), a[1] + middle * (b[1] - a[1]), both);
        bool covered = true;
        for (int i = 0; i < 2; ++i) {
            const double clear = clearance(both[i]);
            if (clear <= kFloor) return false;
            covered = covered && clear > half * reach[i];
        }
        half /= 2;
        return covered || (freeAround(a, b, middle - half, half, reach) && freeAround(a, b, middle + half, half, reach));
    }
};

// Reads lines such as `circle X Y R`, `polygon X Y X Y X Y`, `start Q1 Q2`.
Arm read(std::istream &in);
