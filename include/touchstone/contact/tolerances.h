// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_tolerances_h
#define touchstone_contact_tolerances_h

namespace Touchstone
{
  /**
   * @brief The geometric tolerances of contact, each once.
   *
   * All are without unit. Lengths are fractions of the size of a face, areas of its area, so
   * nothing depends on the system of units.
   */
  namespace Tolerances
  {
    // ---------------------------------------------------------------- angles between surfaces

    /** Cosine of the angle between the normals of two faces that meet in a sharp edge of the body
     * (50 degrees). Across it normals are not averaged, and a node in contact keeps its face as
     * long as `keeps_face` allows. A coarse arc has up to 45 degrees per face. */
    constexpr double sharp_edge_cosine = 0.64;

    /** Cosine of the angle between the normals of faces that meet in an edge which can touch
     * another edge (30 degrees): less than sharp_edge_cosine, because between flatter faces rows of
     * nodes describe the contact well enough. */
    constexpr double touching_edge_cosine = 0.866;

    /** Cosine of the angle between the normal of a face and the mean of all around a node, at which
     * the node lies on a sharp edge: two faces at sharp_edge_cosine have 0.905. */
    constexpr double sharp_node_cosine = 0.9;

    /** Cosine between the averaged normals of a face at a point of its edge and the mean over all
     * faces there, below which faces beyond a sharp edge have been left out of the former. */
    constexpr double same_normal_cosine = 0.999;

    /** Cosine of the angle between slave and master normal above which a master face is a back
     * face, on the side of its body that is turned away: it must not become the partner of the
     * node. Clearly above zero, so that faces around an edge of the slave body find their partners
     * on both sides. */
    constexpr double back_face_cosine = 0.3;

    /** Normals that differ from perpendicular by less than this (cosine) neither face each other
     * nor away. A master face covers a slave face only beyond: those that are seen edge-on are
     * projected onto slivers. */
    constexpr double perpendicular_cosine = 0.1;

    /** Cosines of the angle between a slave face and the master surface: from the first on (45
     * degrees) less than all of the area counts in averaged rows, from the second on (72 degrees)
     * nothing (doc/theory.md 3). */
    constexpr double inclined_cosine = 0.7, steep_cosine = 0.3;

    /** The same by averaged normals, at which it is clear that all of it counts. */
    constexpr double hardly_inclined_cosine = 0.85;

    // ---------------------------------------------------------------- positions on a face

    /** Face coordinates by which a point may lie outside of [-1, 1] by round-off. */
    constexpr double face_coordinate = 1e-9;

    /** Shape functions and stencil weights below it are zero but for round-off. */
    constexpr double negligible_weight = 1e-14;

    // ---------------------------------------------------------------- lengths by the size of a
    // face

    /** Closer to an edge of a face than this a point lies on it, and places that are equal but for
     * this are equally good: round-off must not choose among them. */
    constexpr double on_edge = 1e-7;

    /** A node that is as close to two faces but for this lies on the edge between them and has the
     * mean of their rows. Exact surfaces that turned with their facets lay over each other by some
     * 1e-3 of a face beside a common edge, their normals there differed by as much, and a node that
     * symmetry puts on the edge had a balance on either side, too, up to 2e-6 away: solvers
     * differed by up to 3e-4 of a force. */
    constexpr double between_faces = 1e-5;

    /** Surfaces that are so close at the start of a run or of a step touch: they start in contact,
     * such an overlap is none, and a node has not passed through the face. */
    constexpr double touches_at_start = 1e-6;

    /** Beyond an edge by more than this a point lies in the wedge over it. */
    constexpr double in_wedge = 1e-6;

    /** By the reach of a search: a point lies on the line of an edge, and the direction from there
     * says nothing. */
    constexpr double on_the_edge_line = 1e-8;

    /** Squares of distances, relative to each other, that are equal up to round-off. */
    constexpr double equal_squares = 1e-12;

    /** By the length of the step: faces that meet in an edge are passed at the same time. */
    constexpr double same_time = 1e-8;

    /** Closer than this surfaces touch, inside or outside: there are states in balance with gaps of
     * this size, by Newton's tolerance and the geometry of facets. */
    constexpr double touching = 1e-3;

    /** A node in contact keeps its face across a sharp edge unless another is closer by this. */
    constexpr double keeps_face = 1e-3;

    /** Relative displacements within a step that are smaller than this, by the size of a face,
     * cannot pass through a body. */
    constexpr double small_motion = 0.1;

    /** By the shortest edge: nodes that move by less do not change which faces may cover each
     * other, if those beside them are kept as well. */
    constexpr double negligible_motion = 0.02;

    /** A node in contact leaves the master surface this many times as far beyond its edge as an
     * open node arrives (hysteresis): with equal distances it would alternate for ever. */
    constexpr double edge_hysteresis = 5.;

    /** By how deep it is behind a face: what is covered of a slave surface is a strip beside a side
     * of the master, and has not come through that face. */
    constexpr double strip = 0.1;

    // ---------------------------------------------------------------- contact of a body with
    // itself

    /** Cosine between the line from a node to a face of its own body and the normal there (60
     * degrees): with less the closest point is at the end of what the node can meet. Between
     * facets that bend without a sharp edge it is above 0.8. */
    constexpr double about_normal = 0.5;

    /** Sine of the angle by which a point lies in front of a face in the reference state: with less
     * it is on the same plane. */
    constexpr double behind_face = 0.01;

    /** A point that is not in front of a face of its own body in the reference state meets it if
     * its depth is less than the first part of their distance there: walls are not pressed to a
     * quarter of their thickness, and what meets comes from beyond four times the depth. Deeper
     * than the second, the material between them would have been pulled to twice its length. */
    constexpr double come_closer = 0.25, through_material = 2.;

    /** By the depth of the cell behind a face, what a point of the same body may lie behind it in
     * the reference state where surfaces have been made to overlap: twice as much as is accepted at
     * the start, and less than any wall is thick. */
    constexpr double made_to_overlap = 0.05;
    /** Cosine of the angle between the normals of such surfaces (154 degrees). */
    constexpr double opposed = -0.9;
    /** By the size of a face, the distance of two points in the reference state whose surfaces
     * touch there: slip may be larger than the gap between them. */
    constexpr double made_to_touch = 0.1;

    // ---------------------------------------------------------------- partial cover

    /** By the mean cover of a face, limits of the step S in doc/theory.md 3.1: below the first the
     * basis function of a node is aggregated entirely with others, above the second the node keeps
     * all of its row. With two thirds of a face covered nodes beyond the edge of the cover have
     * 0.6. Where rows are kept or aggregated as a whole, as tied ones are and those beside which
     * another pair covers the rest, a third decides: two thirds of that which a node has on a face
     * half of which is covered, so that round-off does not. Between the two limits, where the step
     * S leaves the choice open, it remains that of the last step: below the first, rows of slivers
     * would be left, above the second, nodes may receive parts of others. */
    constexpr double gives_all = 0.2, keeps_all = 0.6, keeps_if_at_once = 1. / 3.;

    /** Largest ratio r of the area that a node has lost to that which it keeps, beyond which
     * it has no row (CoverSums::loss()); and the growth of the gap, by the size of the face, at r =
     * 1 (doc/theory.md 3.1, equation (6)). It grows with the fourth power of r, so that for gaps
     * from 1e-5 to 0.1 of a face the row opens while the edge moves by a good part of a face. */
    constexpr double most_lost = 3., gap_growth = 0.01;

    /** Kept area by the tributary area below which a node has no row. */
    constexpr double least_cover = 1e-6;

    /** Part of the area of a node from which on all of it counts as covered by one pair; and from
     * the first to the second it counts as covered by all pairs together (doc/theory.md 3.1, "Faces
     * that several pairs cover"): surfaces of two bodies side by side need not fit exactly. */
    constexpr double nearly_covered = 0.999, shared_from = 0.8, shared_to = 0.95;

    /** By the size of a face: the slave point of a row of a tied pair lies on the master facets. */
    constexpr double no_offset = 1e-9;

    /** Determinant of the edges of a cell at a corner, by the third power of their size, below
     * which the cell is flat there and has no gradient. */
    constexpr double flat_cell = 1e-6;

    /** Part of a nodal area that may be missing by round-off where all is covered. */
    constexpr double fully_covered = 1e-10;

    /** Part of the sagitta of a row, weighted by area, from which on one face can decide alone
     * whether surfaces are pressed flat: less than what one face has that is half as large as the
     * three others, beside hanging nodes, 1/49. With less it counts less, so that faces come and
     * go smoothly. */
    constexpr double fair_part = 1. / 64.;

    /** What a face that bends less than others at its node takes from the gap there, by its own
     * sagitta and not that of the row: 5/12 of it is lost of the motion of a node that moves alone,
     * on square faces, so that a quarter of this motion is left. With half of it left (6/5) small
     * faces beside hanging nodes, pressed flat, have gaps above the mean. */
    constexpr double most_of_sagitta = 9. / 5.;

    /** By how much the part of the curvature between two surfaces that is left on a face may be
     * mistaken, because it is not constant, as on a coarse ball: bodies that only touch must have
     * no force. */
    constexpr double odd_curvature = 0.05;

    /** How far the mean gap is below that of the node because of the shape of both surfaces, by how
     * far the slave surface is from its facets, that is their relative difference of curvature:
     * from the first to the second the gap of the node comes to count. Beside a plane it is one.
     * Between surfaces that nearly fit the strain cannot be told from a difference of curvature,
     * and with larger limits bodies that only touch overlap by as large a part of an arch: the
     * first is about the strain of metals that are elastic. With larger strain rows depend on their
     * neighbours and cost iterations, not accuracy: with 1 % prm/two_tubes.prm takes as many as
     * with limits four times as large, with 3 % it takes 47 instead of 41 for the same force. */
    constexpr double hardly_curved = 0.005, well_curved = 0.02;

    /** Added to that distance by the size of a face, for slave surfaces that are flat: times the
     * former it is twice touches_at_start. Differences of gaps that are smaller are no shape; the
     * square of a strain makes such. */
    constexpr double flat_arch = 4e-4;

    /** The same at a node that is not covered: there a difference of gaps is made by the tilt
     * between the surfaces as well, times the strain. Times hardly_curved it is the difference of a
     * tilt and a strain that are as large as the second of those limits. */
    constexpr double flat_arch_beside = well_curved * well_curved / hardly_curved;

    /** One less the shape function of a node at the closest covered point, from the first to the
     * second of which the gap there ceases to count for that of its row. A node beyond an edge has
     * a row where at least a third of its face is covered. */
    constexpr double near_node = 2. / 3., far_of_node = 0.8;

    /** The same from which on the node is clearly not covered, so that means are extrapolated. */
    constexpr double clearly_beside = 0.1;

    /** Part of the difference between the gap at a node and the smallest one on its face by which
     * its row remains above the latter: rows of neighbours over the same lowest point must not be
     * the same condition. */
    constexpr double above_least = 0.1;

    /** By the size of a face: from the first to the second the smallest gap comes to bound the gap
     * of a row. */
    constexpr double hardly_open = 1e-4, well_open = 1e-2;

    /** By the size of a face: gaps are equal up to round-off, as mean and closest one are on flat
     * faces. */
    constexpr double equal_gaps = 1e-10;

    /** Added to the diagonal of the mass matrix of a covered part, by its trace: on slivers it is
     * singular to working precision. The weights are refined until it has no effect. */
    constexpr double mass_regularisation = 1e-14;

    /** Common parts of projected faces that are smaller by area are round-off, and so are corners
     * that cut off less. Much less than what Newton's method resolves: where a corner of one face
     * lies on a corner of another, what is left of it changes from one iterate to the next. */
    constexpr double sliver = 1e-12;

    /** By the area of a polygon: corners whose triangles with their neighbours are smaller count as
     * straight, the more the smaller; and by this, those that are equally straight. */
    constexpr double straight_corner = 1e-2, equally_straight = 1e-8;

    /** Of the ways to divide a polygon with straight corners, by their shares, those that are left
     * out. */
    constexpr double smallest_share = 1e-10;

    /** Areas, relative to each other, that are equal up to round-off. */
    constexpr double equal_areas = 1e-9;

    /** A master face lies behind another if that covers this part of it; otherwise beside it. */
    constexpr double behind = 0.1;

    // ---------------------------------------------------------------- what rows cannot describe

    /** How deep sharp edges and vertices may reach into the other body, by the edge or the face:
     * surfaces that are balanced with all their rows fit within less. */
    constexpr double deep_edge = 0.02;

    /** The same for a node of a smooth surface, which reaches into a coarser face by the
     * height of the arc over it before the nodes of that meet anything. */
    constexpr double deep_smooth_node = 0.1;

    /** Forces that would take the overlaps beside carrying nodes away, over those that the rows
     * carry, from which on the latter may be wrong by a factor (doc/theory.md 4.1). With ratios of
     * 1.4 and 2.4 forces were 10 and 21 % off. */
    constexpr double narrow_contact = 4.;

    /** How deep a surface node may lie in another cell of the surface, by its thickness, before
     * bodies count as overlapping; and the distance from inner faces, which nodes that hang lie on,
     * from which it lies in a cell at all. */
    constexpr double deep_in_body = 0.25, within_cell = 1e-3;

    /** The same of nodes that lie on no boundary which a pair names, in cells and in obstacles:
     * these are no points of facets, nor are they kept away on an average only. */
    constexpr double unnamed_in_body = 0.05, node_in_obstacle = 0.02;

    /** Distance of edges that come close, by the shorter one. */
    constexpr double near_edge = 0.1;

    /** Contact forces that a balance does not determine, by the largest of the scene: what
     * iterative solvers leave. */
    constexpr double undetermined_force = 1e-9;

    /** The same by the stiffness of the bodies: round-off of displacements, by the size of a face,
     * and of positions, by the distance from the origin. */
    constexpr double undetermined_strain = 1e-13, undetermined_position = 1e-15;

    /** Part of the force of a pair below which its direction does not matter. */
    constexpr double small_force = 0.1;

    /** Sine of the angle by which a force may lie outside the normals of the slave surface: about
     * 20 degrees, more than the normals of coarse facets stray. */
    constexpr double oblique_sine = 0.35;

    /** Cosine of the angle within which the perpendicular of two edges counts as the normal of a
     * face (15 degrees): a face touches there, which rows describe. */
    constexpr double along_normal_cosine = 0.966;

    /** Sine of the angle below which edges count as parallel. */
    constexpr double parallel_sine = 0.2;

    /** Angle, in radian, by which a perpendicular may lie outside the plane of two normals. */
    constexpr double out_of_plane = 0.1;

    /** Angle, in radian, of the directions normal to both of two parallel edges, from which on the
     * edges touch each other and not a face the edge. */
    constexpr double edges_touch = 0.1;

    /** By the size of its faces: a slave node that is no farther from an edge of the master, in
     * front of it or, in an iterate, behind it, may stand on the edge; and by the depth behind it,
     * how much farther beside it than `touching`. */
    constexpr double onto_edge = 2., beside_edge = 0.1;

    /** By the length of an edge: feet that far beyond its end count where edges bend at a node, so
     * that no crossing is lost between two perpendiculars. */
    constexpr double beyond_bend = 0.05;

    /** Cosine of the angle between edges that go on in each other at a node. */
    constexpr double edge_goes_on = 0.64;

    /** By the weight of its slave node at the point where a row between nodes touches: with less
     * the row goes to another node of the edge or face, even if it began the step with this one. */
    constexpr double least_share = 0.2;

    /** The same weight from which on the row between nodes stands for that of the node itself. */
    constexpr double at_node = 0.9;

    /** By the length of an edge: feet of perpendiculars that lie beyond its end by round-off. */
    constexpr double edge_end = 1e-6;
  } // namespace Tolerances
} // namespace Touchstone

#endif
