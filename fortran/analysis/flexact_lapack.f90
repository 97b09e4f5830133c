!> Interfaces of the LAPACK routines that are used.
module flexact_lapack
   use flexact_kinds, only: wp
   implicit none
   private
   public :: dgesdd, dgeqrf, dorgqr

   interface
      !> Singular value decomposition by divide and conquer; a is destroyed.
      pure subroutine dgesdd(jobz, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, iwork, info)
         import :: wp
         character, intent(in) :: jobz
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: s(*)
         real(wp), intent(inout) :: u(ldu, *), vt(ldvt, *), work(*)
         integer, intent(inout) :: iwork(*)
         integer, intent(out) :: info
      end subroutine dgesdd

      !> QR factorisation by Householder reflections, in place.
      pure subroutine dgeqrf(m, n, a, lda, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(out) :: tau(*)
         integer, intent(out) :: info
      end subroutine dgeqrf

      !> The first n columns of Q from the reflections of dgeqrf, in place.
      pure subroutine dorgqr(m, n, k, a, lda, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, k, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(in) :: tau(*)
         integer, intent(out) :: info
      end subroutine dorgqr
   end interface
end module flexact_lapack
