# Carries a program that was written for 0.2 over to the names of 0.3:
#
#     sed -E -i -f renames.sed FILE...
#
# Names of two meanings are renamed where what stands before them tells which one is meant (`.fixed`, not `fixed`): look at
# the compiler's messages for what is left. CHANGELOG.md has the same table with reasons, and says what moved in the build.

# headers
s/core\/detail\/twice\.hpp/core\/double_double.hpp/g
s/core\/twice\.hpp/core\/double_double.hpp/g
s/solve\/judge\.hpp/solve\/forward_error.hpp/g
s/solve\/stairs\.hpp/solve\/bound_status.hpp/g
s/solve\/penalty_factor\.hpp/solve\/penalised_cholesky.hpp/g
s/form\/h1_norm\.hpp/form\/h1_gram_matrix.hpp/g
s/solve\/(detail\/)?tuned\.hpp/solve\/defaults.hpp/g
s/form\/(detail\/)?averaged\.hpp/form\/strain_projection.hpp/g
s/(problem|models)\/projected\.hpp/models\/project_strain.hpp/g
s/analysis\/(detail\/)?ties\.hpp/analysis\/layer_components.hpp/g
s/analysis\/lost_energy\.hpp/analysis\/locking_loss.hpp/g
s/analysis\/layer_report\.hpp/analysis\/locking_report.hpp/g
s/analysis\/nearest\.hpp/analysis\/best_approximation.hpp/g
s/(analysis|certificate)\/accurate_enough\.hpp/certificate\/balanced_tolerance.hpp/g
s/distributed\/piece\.hpp/distributed\/partition.hpp/g
s/exact\/(detail\/)?truth_data\.hpp/exact\/exact_solution_data.hpp/g
s/exact\/truth_table\.hpp/exact\/exact_table.hpp/g
s/exact\/truth_distance\.hpp/exact\/exact_norms.hpp/g
s/exact\/beam_truth\.hpp/exact\/exact_beam.hpp/g
s/exact\/plate_truth\.hpp/exact\/exact_plate.hpp/g
s/exact\/truth\.hpp/exact\/exact_solution.hpp/g
s/measure\/(detail\/)?answer\.hpp/measure\/result.hpp/g
s/mesh\/(detail\/)?cut_out\.hpp/mesh\/submesh.hpp/g
s/(runner|io)\/(detail\/)?scene_answer\.hpp/runner\/solve_scene.hpp/g

# core
s/\bTwo\b/DoubleDouble/g
s/\bTwice\b/DoubleDoubleVector/g
s/\bhalf_solve\b/forward/g
s/\bStopped\b/Interrupted/g
s/(\bprogress|\bnow)(\.|->)reached\b/\1\2error/g
s/(\bprogress|\bnow)(\.|->)asked\b/\1\2tolerance/g

# problem
s/(\.|->|::)fixed_values\b/\1dirichlet_values/g
s/(\bproblem|\bP|\bVariationalInequality)(\.|->|::)fixed\b/\1\2dirichlet_dofs/g
s/(\.|->)fixed\b/\1dirichlet_dofs/g
s/\bforce_bound\b/force_limit/g
s/\bset_force_bound\b/set_force_limit/g
s/(\.|->|::)combinations\b/\1constraints/g
s/\bset_fixed\b/set_dirichlet/g
s/\bheld_in_contact\b/equality_constrained/g
s/\brequire_firm_bounds\b/require_hard_bounds/g
s/\bRelativeStiffness\b/StiffnessRatio/g
s/\brelative_stiffness\b/stiffness_ratio/g
s/(\.|->)sum_([01])\b/\1trace_a\2/g
s/(\.|->)most_([01])\b/\1max_a\2/g
s/\busual_penalty\b/default_penalty/g
s/\bmoderate_delta\b/penalty_parameter/g

# solve
s/\bStairs\b/ShiftedBounds/g
s/\bPiece::below\b/BoundStatus::slip_below/g
s/\bPiece::between\b/BoundStatus::inactive/g
s/\bPiece::above\b/BoundStatus::slip_above/g
s/\bPiece\b/BoundStatus/g
s/\bPieces\b/BoundStatuses/g
s/(\.|->)pieces\b/\1status/g
s/\bthere_are\b/nearest_valid/g
s/\bagreed\(/common_status(/g
s/\bwhole_force\b/total_force/g
s/\bContactAnswer\b/ContactResult/g
s/\bstart_by_halves\b/coarse_start/g
s/\bHeldFactor\b/ConstrainedCholesky/g
s/(\.|->)hold\(/\1constrain(/g
s/(\.|->)held\(\)/\1sparse_factor()/g
s/\bFreeNumbering\b/DofOrdering/g
s/\bnumbering(_|\(\))?(\.|->)unknown\b/ordering\1\2dof/g
s/\bnumbering(_|\(\))?(\.|->)place\b/ordering\1\2position/g
s/(\.|->)numbering\(\)/\1ordering()/g
s/\bContactRoad::dense\b/ContactReduction::schur_complement/g
s/\bContactRoad\b/ContactReduction/g
s/(\.|->)road\b/\1reduction/g
s/(\.|->)moderate\b/\1penalised_max_u/g
s/\bLeftOpen\b/ConstraintDefect/g
s/\bleft_open\b/constraint_defect/g
s/(\.|->)for_good\b/\1infeasible_part/g
s/\brequire_an_admissible_u\b/throw_if_infeasible/g
s/\brounding_of_the_factor\b/factor_roundoff/g
s/\bdoubt\(/add_conditioning_error(/g
s/\bTied\b/SlackForm/g
s/\bTrustLevels\b/KktTolerances/g
s/(\.|->)trusted\b/\1warn/g
s/(\.|->)refused\(\)/\1kkt_fail()/g
s/(\.|->)refused\b/\1fail/g
s/\brequire_trusted\b/apply_tolerances/g
s/\bnote_equations\b/add_equations/g
s/\bnote_bound\b/add_bound/g
s/\btuned::most_corrections\b/defaults::max_corrections/g
s/\btuned::equal\b/defaults::row_tolerance/g
s/\btuned::slowest\b/defaults::max_contraction/g
s/\btuned::next_penalty\b/defaults::penalty_reduction/g
s/\btuned::few_rows\b/defaults::max_rows_for_qr/g
s/\btuned::tie\b/defaults::slack_stiffness_ratio/g
s/\btuned::/defaults::/g
s/\bAccurateEnough\b/AlgebraicTolerance/g
s/\bNaiveAnswer\b/NaiveResult/g
s/\bNaiveEnd::settled\b/ConvergedReason::converged/g
s/\bNaiveEnd::refused\b/ConvergedReason::linear_solve_failed/g
s/\bNaiveEnd::step_cap\b/ConvergedReason::max_iterations/g
s/\bNaiveEnd\b/ConvergedReason/g
s/\bPenaltyFactor\b/PenalisedCholesky/g
s/(\bfactor_?)(\.|->)dense\(\)/\1\2cholesky()/g
s/\bDenseContact\b/SchurComplementContact/g
s/\bEquilibrium\b/FixedStatusSolution/g
s/\bcounters(\.|->)contact\b/counters\1contact_iterations/g
s/\boptions(\.|->)step\b/options\1step_length/g

# mesh, space
s/\bheld_group\b/dirichlet_group/g
s/\bloose_triangle\b/find_floating_component/g
s/\bplaced_mesh\b/tag_by_position/g
s/\b(mesh|body)(\.|->)place\(/\1\2location_text(/g
s/\bCutOut\b/Submesh/g
s/\bcut_out\(/submesh(/g
s/\bbody_of\(/body_submesh(/g
s/\bBend\b/CurvedColumn/g
s/(\.|->)bend\b/\1curved_columns/g
s/(\.|->)stretch\(/\1jacobian(/g
s/\bMoreGroups\b/ExtraGroups/g
s/\bper_vertex\b/dofs_per_vertex/g
s/\bper_edge\b/dofs_per_edge/g
s/\bper_triangle\b/dofs_per_cell/g
s/(\.|->)clamped\(\)/\1dirichlet_dofs()/g
s/((\b|_)[sS]pace(_|\(\))?|\.deflection|\.rotation\.[xy])(\.|->)contact\(\)/\1\4contact_dofs()/g
s/((\b|_)[sS]pace(_|\(\))?|\.deflection|\.rotation\.[xy])(\.|->)unknowns\(\)/\1\4cell_dofs()/g
s/((\b|_)[sS]pace(_|\(\))?|\.deflection|\.rotation\.[xy])(\.|->)points\(\)/\1\4dof_coordinates()/g
s/\b(element|element_|element\(\)|p1\(\)|p2\(\)|crouzeix_raviart\(\))(\.|->)nodes\(\)/\1\2support_points()/g
s/\b(element|element_|element\(\)|p1\(\)|p2\(\)|crouzeix_raviart\(\))(\.|->)unknowns\(\)/\1\2dofs()/g

# form, models, scene
s/\bbox_shares\b/box_projection/g
s/\bvertex_shares\b/vertex_projection/g
s/\bShares\b/StrainProjection/g
s/\bprojected_compliance\b/projected_class_parameter/g
s/\bOfGradient\b/GradientCoefficients/g
s/\baveraged\(/project_strain(/g
s/\bprojected\(/project_strain(/g
s/\bStrainRow\b/StrainTerm/g
s/\bstrain_rows\b/strain_form_factored/g
s/\bRowsOfB\b/FactoredFormBuilder/g
s/\bsum_element_matrices\b/assemble_cells/g
s/\bcolumn_starts\b/column_pointers/g
s/\bdivergence_rule\b/strain_quadrature/g
s/\bstrain_rule\b/strain_quadrature/g
s/\bh1_norm\b/h1_gram_matrix/g
s/(\.|->)membrane\(\)/\1plane_strain_modulus()/g
s/\bPress\b/BlockLoading/g
s/(\.|->)push( =|\)|,|;|\})/\1prescribed_displacement\2/g
s/(\.|->)rim( =|\))/\1boundary_deflection\2/g
s/\badd_press\b/add_block_loading/g
s/\brim_slope_x\b/boundary_rotation_x/g
s/\brim_slope_y\b/boundary_rotation_y/g
s/\bEdgeCondition\b/BoundaryCondition/g
s/\bcheck_ceiling\b/check_upper_obstacle/g
s/(\.|->)ceiling\b/\1upper_obstacle/g
s/\bprescribed_values\b/dirichlet_vertex_values/g

# exact, measure
s/\bTruthTable\b/ExactTable/g
s/\bTruthPoint\b/ExactPoint/g
s/\bBeamTruth\b/ExactBeam/g
s/\bPlateTruth\b/ExactPlate/g
s/\bTruth\b/ExactSolution/g
s/\btruth_of\b/exact_solution_of/g
s/\bAnswer\b/Result/g
s/\banswer_scene\b/solve_scene/g
s/\blayer_report_of\b/locking_report_of/g
s/\bPointValues::Place\b/PointValues::Location/g
s/\bFollowers\b/Callbacks/g

# analysis, certificate
s/\bVerdict::does_not_lock_for_this_reason\b/Verdict::not_detected/g
s/\bdoes_not_lock_for_this_reason\b/not_detected/g
s/\b(LockingDiagnosis|LostEnergy)::telling\b/significance/g
s/\bLostEnergy\b/LockingLoss/g
s/\blost_energy\(/locking_loss(/g
s/\bLayerReport\b/LockingReport/g
s/\breport_layer\b/report_locking/g
s/(\.|->)sentence\(\)/\1text()/g
s/\bTies\b/LayerComponents/g
s/\bfind_ties\b/layer_components/g
s/(\.|->)in_columns\b/\1is_aligned/g
s/(\breport|\blayer)(\.|->)found\b/\1\2estimate/g
s/\bNearest\b/BestApproximation/g
s/\bnearest\(/best_approximation(/g
s/\bWithin\b/AdmissibleSet/g
s/\bwidth_of_ball\b/kolmogorov_width/g
s/(\.|->)meet\(\)/\1intersects_kernel()/g
s/\bfree_unknowns\b/free_prolongation/g
s/\bEnergyBracket\b/EnergyBounds/g
s/\benergy_bracket\(/energy_bounds(/g
s/\baccurate_enough\(/balanced_tolerance(/g
s/\bstrip_companion\b/local_companion/g
s/\bCompanion\b/ConformingCompanion/g
s/\bcertificate(\.|->)imbalance\b/certificate\1algebraic_residual_norm/g
s/\bColumnFunction\b/ExtrudedP1Function/g
s/(\.|->)mismatch\b/\1constitutive_error/g
s/(\.|->)softening\b/\1refinement_softening/g

# adapt
s/\bGrowth\b/RefinementStrategy/g
s/\bGrowingMesh\b/AdaptiveMesh/g
s/\bgrown\(/refine_marked(/g
s/\bmarked\(/dorfler_mark(/g
s/\bLevel\b/RefinementLevel/g
s/\bquoted_(unknowns|seconds)\b/predicted_\1/g

# study
s/(\.|->)on\(/\1space(/g
s/\bfile(\.|->)words\b/file\1json/g
s/\bEntry\b/TableEntry/g
s/(\.|->)different\(/\1unique(/g
s/(\.|->)least\("/\1min("/g
s/(\.|->)most\("/\1max("/g
s/(\.|->)where\("/\1filter("/g
s/(\.|->)where_number\(/\1filter_number(/g

# distributed
s/\bdistributed::Inequality\b/distributed::DistributedProblem/g
s/\bPenalty::loop\b/PenaltyChoice::distributed_default/g
s/\bPenalty::rule\b/PenaltyChoice::serial_default/g
s/\bPenalty::compliance\b/PenaltyChoice::none/g
s/\bdistributed::Penalty\b/distributed::PenaltyChoice/g
s/\bpiece_of\b/subdomain_of/g
s/\brefined_piece\b/refined_subdomain/g
s/\bfirst_said\b/first_nonempty/g
s/\bfrom_first\b/broadcast/g
s/\bmost_(iterations|corrections)\b/max_\1/g

s/\bmake_triangle_mesh\b/make_mesh/g
s/\bmeans_on_edge\b/means_on_facet/g
