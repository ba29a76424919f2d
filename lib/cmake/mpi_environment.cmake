# mpi_environment: what mpiexec is told where all ranks are on one machine, a list of NAME=VALUE; mpi_environment_in_shell:
# the same as one text, separated by blanks. Open MPI 4 reads OMPI_...; Open MPI 5 leaves the start of ranks to PRRTE, which
# reads PRTE_.... Each overlooks the names of the other.
set(mpi_environment
  # root may start ranks: a container has no other user
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1
  # more ranks than cores
  OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
  # not bound to cores: a rank that shares its core with another program holds up all of them
  OMPI_MCA_hwloc_base_binding_policy=none PRTE_MCA_hwloc_default_binding_policy=none
  # no network is looked for
  OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader
  # nobody waits a second for ranks that have ended
  OMPI_MCA_odls_base_sigkill_timeout=0 PRTE_MCA_odls_base_sigkill_timeout=0
  OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1)
list(JOIN mpi_environment " " mpi_environment_in_shell)
